// Normals as slopes whose first and second moments can be averaged (Olano and Baker 2010, "LEAN mapping"), for the
// `parameters` baseline.
#pragma once

#include "base/vec.h"

namespace redmap {

/// Slopes in a frame whose z is the surface's interpolated normal: a normal is along (x, y, 1).
struct SlopeMoments {
  static constexpr int kMean = 0;    ///< x, y
  static constexpr int kSecond = 2;  ///< xx, xy, yy
  static constexpr int kCount = 5;
};

/// Writes the moments of one normal, given in that frame. Normals closer to the horizon than 3 degrees count as if
/// they were there.
void slope_moments(Vec3 normal, float* out);

/// A symmetric matrix over x and y.
struct Covariance2 {
  float xx = 0, xy = 0, yy = 0;
};

/// What averaged moments say of the normals: the mean one, unit, in the frame of the slopes, and the covariance of
/// slopes.
struct NormalsOfSlopes {
  Vec3 mean;
  Covariance2 covariance;
};
NormalsOfSlopes normals_of_slopes(const float* moments);

/// The covariance of the normals themselves over x and y of `frame`, whose z is the mean normal; all in the frame of
/// the slopes.
Covariance2 covariance_in_frame(const NormalsOfSlopes& normals, const Frame& frame);

}  // namespace redmap
