#include "map/normal_moments.h"

#include <algorithm>

namespace redmap {
namespace {

// Variance of a direction that no normal varies in, so that flat texels can be inverted: .06 degrees.
constexpr float kVarianceFloor = 1e-6f;

}  // namespace

void normal_moments(Vec3 n, float* out) {
  const float moments[NormalMoments::kCount] = {n.x,       n.y,       n.z,       n.x * n.x, n.x * n.y,
                                                n.x * n.z, n.y * n.y, n.y * n.z, n.z * n.z};
  std::copy(moments, moments + NormalMoments::kCount, out);
}

float squared_deviations(const float* moments, Vec3 direction) {
  // In double: covariances are small differences, and nearly singular along the mean.
  const double mean[3] = {moments[0], moments[1], moments[2]};
  const float* second = moments + NormalMoments::kSecond;
  const double xx = second[0] - mean[0] * mean[0] + kVarianceFloor, xy = second[1] - mean[0] * mean[1],
               xz = second[2] - mean[0] * mean[2], yy = second[3] - mean[1] * mean[1] + kVarianceFloor,
               yz = second[4] - mean[1] * mean[2], zz = second[5] - mean[2] * mean[2] + kVarianceFloor;
  const double d[3] = {direction.x - mean[0], direction.y - mean[1], direction.z - mean[2]};
  // The adjugate over the determinant.
  const double a = yy * zz - yz * yz, b = xz * yz - xy * zz, c = xy * yz - xz * yy;
  const double e = xx * zz - xz * xz, f = xy * xz - xx * yz, g = xx * yy - xy * xy;
  const double determinant = xx * a + xy * b + xz * c;
  constexpr double kLeast = double{kVarianceFloor} * kVarianceFloor * kVarianceFloor;
  const double form =
      a * d[0] * d[0] + e * d[1] * d[1] + g * d[2] * d[2] + 2 * (b * d[0] * d[1] + c * d[0] * d[2] + f * d[1] * d[2]);
  return static_cast<float>(std::max(form, 0.0) / std::max(determinant, kLeast));
}

}  // namespace redmap
