// The shader of a map: a reduction map holds places and a name, not reflectances (paper, section 4.3).
#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "map/reduction_map.h"
#include "scene/scene.h"
#include "shader/shader.h"

namespace redmap {

/// The shader that `map`, read from `path`, was baked from; `device` as in SceneFile::load(). Throws Error where there
/// is none of its name or file any more, or its text has changed.
std::shared_ptr<const Shader> shader_of(const ReductionMap& map, const std::filesystem::path& path,
                                        const std::string& device = "");

/// Throws Error unless `map` was baked for `object` as it is now.
void require_map_of(const Object& object, const ReductionMap& map);

/// Where `shader` comes from, seen from the folder of a map. Nothing for shaders of the library.
ShaderOrigin origin_of(const ShaderInfo& shader, const std::filesystem::path& map_folder);

}  // namespace redmap
