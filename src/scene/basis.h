// The basis reflectances of a map as a shader's patterns: a reduction map holds places, not reflectances (paper,
// section 4.3).
#pragma once

#include <memory>

#include "map/reduction_map.h"
#include "shader/shader.h"

namespace redmap {

/// `shader` at the places of the map's basis, pattern by pattern. It should be the shader that the map was baked from.
std::unique_ptr<BoundPatterns> bind_basis(const Shader& shader, const ReductionMap& map);

}  // namespace redmap
