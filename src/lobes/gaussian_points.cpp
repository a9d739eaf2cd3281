#include "lobes/gaussian_points.h"

#include <cmath>

namespace redmap {

const std::array<Vec2, kDrawnNormals>& gaussian_points() {
  static const std::array<Vec2, kDrawnNormals> points = [] {
    std::array<Vec2, kDrawnNormals> p;
    constexpr float kGoldenAngle = 2.39996323f;
    Vec2 mean;
    for (int i = 0; i < kDrawnNormals; ++i) {
      const float radius = std::sqrt(-2 * std::log(1 - (static_cast<float>(i) + 0.5f) / kDrawnNormals));
      const float angle = kGoldenAngle * static_cast<float>(i);
      p[i] = {radius * std::cos(angle), radius * std::sin(angle)};
      mean = mean + p[i] * (1.0f / kDrawnNormals);
    }
    float xx = 0, xy = 0, yy = 0;
    for (Vec2& q : p) {
      q = q - mean;
      xx += q.x * q.x / kDrawnNormals, xy += q.x * q.y / kDrawnNormals, yy += q.y * q.y / kDrawnNormals;
    }
    // Inverse of the Cholesky factor of the covariance.
    const float l11 = std::sqrt(xx), l21 = xy / l11, l22 = std::sqrt(yy - l21 * l21);
    for (Vec2& q : p) q = {q.x / l11, (q.y - l21 * q.x / l11) / l22};
    return p;
  }();
  return points;
}

}  // namespace redmap
