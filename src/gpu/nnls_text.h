// Non-negative least squares in a shader: the active-set method of analysis/nnls.h with everything in registers.
// Devices have no stack to speak of, and the host knows the size of the basis, so that the text has no index that
// varies. Not part of the public interface.
#pragma once

#include <string>
#include <string_view>

#include "analysis/basis.h"

namespace redmap {

/// Every line of `text` with a $ once for each of `basis` reflectances, its number in place of the $; and `basis` in
/// place of every $K.
std::string for_each_of_basis(std::string_view text, int basis);

/// GLSL: redmap_real and redmap_real3 (double, or float), `RedmapProducts` (own: of a reflectance with itself, of0,
/// of1, ...: with the basis), `RedmapWeights` (of0, ...), `RedmapWeights redmap_solve(RedmapProducts)` and `redmap_real
/// redmap_residual_square(RedmapProducts, RedmapWeights)`.
std::string nnls_text(const ReflectanceBasis& basis, bool has_doubles);

}  // namespace redmap
