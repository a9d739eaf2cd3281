// Where normals are drawn from a Gaussian, the same for everybody.
#pragma once

#include <array>

#include "base/vec.h"

namespace redmap {

/// Normals drawn where no lobe model fits: twice what the paper's supersampling takes in rays, since they cost no ray.
inline constexpr int kDrawnNormals = 32;

/// Points of a Gaussian of variance 1 in the plane: a spiral of equal parts, scaled to exactly that variance.
const std::array<Vec2, kDrawnNormals>& gaussian_points();

}  // namespace redmap
