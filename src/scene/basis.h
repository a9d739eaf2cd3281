// The basis reflectances of a map as a shader's patterns: a reduction map holds places, not reflectances (paper,
// section 4.3).
#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "map/reduction_map.h"
#include "shader/shader.h"

namespace redmap {

/// The shader that `map`, read from `path`, was baked from; `device` as in SceneFile::load(). Throws Error where there
/// is none of its name or file any more, or its text has changed.
std::shared_ptr<const Shader> shader_of(const ReductionMap& map, const std::filesystem::path& path,
                                        const std::string& device = "");

/// Where `shader` comes from, seen from the folder of a map. Nothing for shaders of the library.
ShaderOrigin origin_of(const ShaderInfo& shader, const std::filesystem::path& map_folder);

/// `shader` at the places of the map's basis, pattern by pattern. It should be the shader that the map was baked from.
std::unique_ptr<BoundPatterns> bind_basis(const Shader& shader, const ReductionMap& map);

}  // namespace redmap
