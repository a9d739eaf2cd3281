#include "map/slope_moments.h"

#include <algorithm>

namespace redmap {
namespace {

constexpr float kLowestCosine = 0.05f;  // slopes up to 20

}  // namespace

void slope_moments(Vec3 normal, float* out) {
  const float z = std::max(normal.z, kLowestCosine), x = normal.x / z, y = normal.y / z;
  out[SlopeMoments::kMean] = x, out[SlopeMoments::kMean + 1] = y;
  out[SlopeMoments::kSecond] = x * x, out[SlopeMoments::kSecond + 1] = x * y, out[SlopeMoments::kSecond + 2] = y * y;
}

NormalsOfSlopes normals_of_slopes(const float* moments) {
  const float x = moments[SlopeMoments::kMean], y = moments[SlopeMoments::kMean + 1];
  const float* second = moments + SlopeMoments::kSecond;
  // Rounding may leave variances a little below zero.
  const float xx = std::max(second[0] - x * x, 0.0f), yy = std::max(second[2] - y * y, 0.0f);
  const float largest = std::sqrt(xx * yy), xy = std::clamp(second[1] - x * y, -largest, largest);
  return {normalized({x, y, 1}), {xx, xy, yy}};
}

Covariance2 covariance_in_frame(const NormalsOfSlopes& normals, const Frame& frame) {
  // A change of slope moves the end of (x, y, 1), which is 1 / cosine long, and of that only what is across counts.
  const float cosine = normals.mean.z;
  const float xx = normals.covariance.xx, xy = normals.covariance.xy, yy = normals.covariance.yy;
  const auto between = [&](Vec3 a, Vec3 b) {
    return cosine * cosine * (a.x * b.x * xx + (a.x * b.y + a.y * b.x) * xy + a.y * b.y * yy);
  };
  return {between(frame.x, frame.x), between(frame.x, frame.y), between(frame.y, frame.y)};
}

}  // namespace redmap
