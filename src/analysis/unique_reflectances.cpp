#include "analysis/unique_reflectances.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/random.h"

namespace redmap {
namespace {

/// Width of a quantisation cell in units of a row's RMS: a twelfth of the default tolerance.
constexpr float kCell = 2e-3f;
/// Seed of the projections; any will do.
constexpr std::uint64_t kSeed = 3;

/// Standard normal from two uniform numbers (Box and Muller 1958).
float normal_deviate(Random& random) {
  const float radius = std::sqrt(-2 * std::log(1 - random.next_float()));
  return radius * std::cos(2 * kPi * random.next_float());
}

}  // namespace

ReflectanceKeys::ReflectanceKeys(const std::vector<float>& row_scales)
    : rows_(static_cast<int>(row_scales.size())), projection_(kProjections * row_scales.size()) {
  Random random(kSeed);
  for (std::size_t i = 0; i < projection_.size(); ++i)
    projection_[i] = normal_deviate(random) * row_scales[i % rows_] / (kCell * std::sqrt(static_cast<float>(rows_)));
}

void ReflectanceKeys::compute(const SampledReflectances& sampled, std::vector<std::uint64_t>& keys,
                              LaneVector<float>& sums) const {
  const std::size_t stride = sampled.stride;
  sums.assign(kProjections * stride, 0.0f);
  for (int r = 0; r < rows_; ++r) {
    const float* values = sampled.row(r);
    for (int p = 0; p < kProjections; ++p) {
      const float factor = projection_[p * rows_ + r];
      float* sum = &sums[p * stride];
      for (std::size_t i = 0; i < stride; ++i) sum[i] += factor * values[i];
    }
  }
  keys.assign(sampled.places, 0);
  for (std::size_t i = 0; i < sampled.places; ++i)
    for (int p = 0; p < kProjections; ++p)
      keys[i] = hash64(keys[i], static_cast<std::uint64_t>(std::llrint(sums[p * stride + i])));
}

UniqueReflectances::UniqueReflectances(int rows, std::size_t capacity) : rows_(rows), capacity_(capacity) {}

void UniqueReflectances::insert(std::uint64_t key, const float* scaled, const ReflectancePlace& place) {
  if (!wants(key)) return;
  index_.emplace(key, static_cast<std::uint32_t>(keys_.size()));
  keys_.push_back(key);
  scaled_.insert(scaled_.end(), scaled, scaled + rows_);
  places_.push_back(place);
  // Twice the capacity before sorting out, so that this costs a constant per insertion.
  if (keys_.size() >= 2 * capacity_) keep_smallest();
}

void UniqueReflectances::insert(std::uint64_t key, const ReflectancePlace& place) {
  if (wants(key)) insert(key, std::vector<float>(rows_).data(), place);
}

void UniqueReflectances::finish() { keep_smallest(); }

void UniqueReflectances::keep_smallest() {
  std::vector<std::uint32_t> order(keys_.size());
  std::iota(order.begin(), order.end(), 0u);
  std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) { return keys_[a] < keys_[b]; });
  if (order.size() > capacity_) {
    order.resize(capacity_);
    largest_key_ = keys_[order.back()];
  }
  UniqueReflectances kept(rows_, order.size() + 1);
  for (std::uint32_t i : order) kept.insert(keys_[i], scaled(i), places_[i]);
  index_.swap(kept.index_), keys_.swap(kept.keys_), scaled_.swap(kept.scaled_), places_.swap(kept.places_);
}

double UniqueReflectances::distinct() const {
  const double kept = static_cast<double>(keys_.size());
  if (largest_key_ == ~std::uint64_t{0}) return kept;
  return (kept - 1) / (static_cast<double>(largest_key_) * 0x1p-64);
}

}  // namespace redmap
