// Normals as their mean and second moments, which can be averaged (Olano and North 1997), for the paper's own method.
#pragma once

#include "base/vec.h"

namespace redmap {

struct NormalMoments {
  static constexpr int kMean = 0;    ///< x, y, z: a mean, no unit vector
  static constexpr int kSecond = 3;  ///< xx, xy, xz, yy, yz, zz
  static constexpr int kCount = 9;
};

/// Writes the moments of one unit normal.
void normal_moments(Vec3 normal, float* out);

/// How many standard deviations, squared, the unit vector `direction` lies from the mean: through the inverse of the
/// 3 x 3 covariance, as in the paper's section 5.2.
float squared_deviations(const float* moments, Vec3 direction);

}  // namespace redmap
