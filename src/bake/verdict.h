// How well a map can stand in for its shader, and whether something simpler would have done.
#pragma once

#include "bake/project.h"

namespace redmap {

/// Sets `map.verdict` and its reason from what the bake found out.
void judge(const TexelGrid& grid, const Shader& shader, const SampledTexels& sampled, ReductionMap& map);

}  // namespace redmap
