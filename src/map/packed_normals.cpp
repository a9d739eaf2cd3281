// Six bytes a Gaussian of normals. Linear bytes for the covariance double the error on smooth surfaces, logarithmic
// ones lose nothing that can be seen (docs/normals.md).
#include <algorithm>
#include <cmath>

#include "map/normal_pyramid.h"

namespace redmap {
namespace {

/// Standard deviations from .001 to 1, 2.8 % apart; byte 0 is none at all.
constexpr float kSmallest = 1e-3f, kLogSteps = 254;
constexpr float kLogRange = 6.90775528f;  // log(1 / kSmallest)
constexpr float kAngleSteps = 256;        // of half a turn

std::uint8_t packed_deviation(float variance) {
  const float deviation = std::sqrt(std::max(variance, 0.0f));
  if (deviation < 0.7f * kSmallest) return 0;
  const float step = std::log(deviation / kSmallest) * (kLogSteps / kLogRange);
  return static_cast<std::uint8_t>(1 + std::lrint(std::clamp(step, 0.0f, kLogSteps)));
}

}  // namespace

PackedTables::PackedTables() {
  for (int i = 0; i < 256; ++i) {
    const float deviation = kSmallest * std::exp(static_cast<float>(i - 1) * (kLogRange / kLogSteps));
    variance[i] = i == 0 ? 0 : deviation * deviation;
    const float twice = 2 * kPi * static_cast<float>(i) / kAngleSteps;
    cosine[i] = std::cos(twice), sine[i] = std::sin(twice);
  }
}
const PackedTables kPackedTables;

PackedNormals pack(const NormalGaussian& n) {
  const auto mean = [](float value) {
    return static_cast<std::uint32_t>(std::lrint(std::clamp(value, -1.0f, 1.0f) * kPackedMeanSteps) + 2048);
  };
  const std::uint32_t x = mean(n.x), y = mean(n.y);
  const float half_sum = 0.5f * (n.xx + n.yy), half_difference = 0.5f * (n.xx - n.yy);
  const float root = std::sqrt(half_difference * half_difference + n.xy * n.xy);
  const float twice = std::atan2(n.xy, half_difference);  // twice the angle of the larger axis
  const int angle = static_cast<int>(std::lrint(twice * (kAngleSteps / (2 * kPi)))) & 255;
  return {{static_cast<std::uint8_t>(x & 255), static_cast<std::uint8_t>(x >> 8 | (y & 15) << 4),
           static_cast<std::uint8_t>(y >> 4), packed_deviation(half_sum + root), packed_deviation(half_sum - root),
           static_cast<std::uint8_t>(angle)}};
}

}  // namespace redmap
