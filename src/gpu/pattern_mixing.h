// Mixing the bound patterns of a basis before they are asked, where radiance() is affine in what they differ in: one
// call then stands for many. Wood, rock and paint that mix coatings are all of this kind. Not part of the public
// interface.
#pragma once

#include <span>
#include <string>

#include "shader/shader_text.h"

namespace redmap {

/// `void redmap_blend(inout Pattern, Pattern, float)`, which moves every float of the first by a part of the way to the
/// second; integers and booleans stay. Read from the declaration of `struct Pattern` in `sources`; empty where that is
/// more than plain members of plain types.
std::string blend_text(const ShaderSources& sources);

/// `RedmapMixed`, `redmap_mixed()` and `redmap_of_mixed()` as in kernels/unmixed.glsl, with one call for each group;
/// REDMAP_MIXES_ALL where there is one.
/// `groups`: of each basis reflectance, 0, 1, ... in the order in which they come up. Follows blend_text().
std::string mixing_text(std::span<const int> groups);

}  // namespace redmap
