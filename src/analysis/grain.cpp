#include "analysis/grain.h"

#include <array>
#include <cmath>

namespace redmap {
namespace {

constexpr int kAzimuths = 12;
/// Radians from the normal. Where a lobe is narrow the inner ones are still lit; they count by what they see.
constexpr std::array kPolar{0.03f, 0.08f, 0.2f, 0.4f, 0.7f};
/// Second harmonics below this part of the mean are rounding, or no grain that shows.
constexpr float kLeastHarmonic = 0.01f;

DirectionPairs retro_directions() {
  DirectionPairs pairs;
  pairs.resize(kAzimuths * kPolar.size());
  for (std::size_t i = 0; i < pairs.to_light.stride(); ++i) {
    const std::size_t k = i % (kAzimuths * kPolar.size());
    const float polar = kPolar[k / kAzimuths], azimuth = 2 * kPi * static_cast<float>(k % kAzimuths) / kAzimuths;
    const Vec3 d{std::sin(polar) * std::cos(azimuth), std::sin(polar) * std::sin(azimuth), std::cos(polar)};
    pairs.to_light.set(i, d), pairs.to_viewer.set(i, d);
  }
  return pairs;
}

}  // namespace

std::vector<Grain> estimate_grain(const BoundPatterns& patterns) {
  const DirectionPairs pairs = retro_directions();
  LaneVector<float> radiance;
  patterns.radiance_all(pairs, radiance);
  const std::size_t stride = padded(patterns.size());
  std::vector<Grain> grain(patterns.size());
  for (std::size_t i = 0; i < grain.size(); ++i) {
    float cosine = 0, sine = 0, mean = 0;
    for (std::size_t k = 0; k < pairs.size(); ++k) {
      const float* at = &radiance[3 * k * stride + i];
      const float r = at[0] + at[stride] + at[2 * stride];
      const float twice = 4 * kPi * static_cast<float>(k % kAzimuths) / kAzimuths;
      cosine += r * std::cos(twice), sine += r * std::sin(twice), mean += r;
    }
    const float harmonic = std::sqrt(cosine * cosine + sine * sine);
    if (!(harmonic > kLeastHarmonic * mean)) continue;
    const float angle = 0.5f * std::atan2(sine, cosine);
    grain[i] = {{std::cos(angle), std::sin(angle)}, true};
  }
  return grain;
}

}  // namespace redmap
