#include "analysis/sampling.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace redmap {
namespace {

/// Rows with less than this part of the largest RMS are taken for zero: what is left of them is rounding.
constexpr double kZeroRow = 1e-6;

void copy_rows(const Planes<3>& rgb, int first_row, SampledReflectances& out) {
  for (int c = 0; c < 3; ++c) std::copy_n(rgb[c], out.places, out.row(first_row + c));
}

/// Without their signs, floats are ordered like the integers of the same bits; NaN and infinity come last.
bool is_unsound(float value) {
  constexpr std::uint32_t kMagnitude = 0x7FFFFFFF;
  return (std::bit_cast<std::uint32_t>(value) & kMagnitude) >= std::bit_cast<std::uint32_t>(kUnsoundValue);
}

}  // namespace

std::optional<std::size_t> find_unsound_place(const SampledReflectances& sampled) {
  std::size_t first = sampled.places;
  for (int r = 0; r < sampled.rows; ++r) {
    const float* row = sampled.row(r);
    // Nearly always there is none: a loop without branches finds that out.
    std::uint32_t any = 0;
    for (std::size_t i = 0; i < sampled.places; ++i) any |= static_cast<std::uint32_t>(is_unsound(row[i]));
    if (any) first = std::min(first, static_cast<std::size_t>(std::find_if(row, row + first, is_unsound) - row));
  }
  return first < sampled.places ? std::optional(first) : std::nullopt;
}

ReflectanceSampler::ReflectanceSampler(const ShaderInfo& shader, DirectionPairs directions)
    : directions_(std::move(directions)), transmits_(shader.transmits), emits_(shader.emits) {}

int ReflectanceSampler::rows() const { return static_cast<int>(3 * (directions_.size() + 1 + (emits_ ? 1 : 0))); }

void ReflectanceSampler::sample(const BoundPatterns& patterns, SampledReflectances& out) const {
  out.places = patterns.size();
  out.stride = padded(out.places);
  out.rows = rows();
  patterns.radiance_all(directions_, out.values);
  out.values.resize(out.rows * out.stride);

  const int transmittance_row = static_cast<int>(3 * directions_.size());
  std::fill_n(out.row(transmittance_row), 3 * out.stride, 0.0f);
  Planes<3> rgb;
  if (transmits_) {
    patterns.transmittance(rgb);
    copy_rows(rgb, transmittance_row, out);
  }
  if (emits_) {
    patterns.emission(rgb);
    copy_rows(rgb, transmittance_row + 3, out);
  }
}

void RowScaling::add(const SampledReflectances& sampled) {
  square_sums_.resize(sampled.rows);
  places_ += sampled.places;
  for (int r = 0; r < sampled.rows; ++r) {
    const float* row = sampled.row(r);
    for (std::size_t i = 0; i < sampled.places; ++i) square_sums_[r] += static_cast<double>(row[i]) * row[i];
  }
}

std::vector<float> RowScaling::scales() const {
  const double largest = square_sums_.empty() ? 0 : *std::max_element(square_sums_.begin(), square_sums_.end());
  const auto scale = [&](double square_sum) {
    return square_sum > 0 ? static_cast<float>(std::sqrt(static_cast<double>(places_) / square_sum)) : 1.0f;
  };
  std::vector<float> scales(square_sums_.size());
  for (std::size_t r = 0; r < scales.size(); ++r)
    scales[r] = scale(square_sums_[r] > kZeroRow * kZeroRow * largest ? square_sums_[r] : largest);
  return scales;
}

void scaled_reflectance(const SampledReflectances& sampled, std::size_t place, const std::vector<float>& scales,
                        float* out) {
  for (int r = 0; r < sampled.rows; ++r) out[r] = scales[r] * sampled.row(r)[place];
}

}  // namespace redmap
