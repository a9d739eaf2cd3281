#include "analysis/held_out.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "analysis/basis.h"
#include "analysis/sampling.h"
#include "base/random.h"

namespace redmap {
namespace {

/// Held-out pairs: enough for every lobe that is wider than some degrees to be met by several.
constexpr int kHeldOut = 128;
/// How far from the mirror direction the nearer half may lie, as an offset of unit vectors.
constexpr float kNearMirror = 0.35f;

/// A residual so many times the tolerance is a disagreement: random directions that graze a highlight vary by that.
constexpr float kDisagreement = 3;
/// Directions added in a round, and rounds.
constexpr int kAddedAtOnce = 8, kRounds = 4;

Vec3 random_direction(Random& random) {
  // Not at the horizon, where nothing arrives.
  const float z = 0.1f + 0.9f * random.next_float(), azimuth = 2 * kPi * random.next_float();
  const float r = std::sqrt(1 - z * z);
  return {r * std::cos(azimuth), r * std::sin(azimuth), z};
}

/// Sampled reflectances with every row scaled to unit RMS, place by place.
struct ScaledVectors {
  std::vector<float> values;
  int rows = 0;
  const float* operator[](std::size_t place) const { return &values[place * rows]; }
};

ScaledVectors sample_scaled(const BoundPatterns& patterns, const DirectionPairs& directions) {
  SampledReflectances sampled;
  ReflectanceSampler(ShaderInfo{}, directions).sample(patterns, sampled);
  RowScaling scaling;
  scaling.add(sampled);
  const std::vector<float> scales = scaling.scales();
  ScaledVectors vectors{std::vector<float>(patterns.size() * sampled.rows), sampled.rows};
  for (std::size_t i = 0; i < patterns.size(); ++i)
    scaled_reflectance(sampled, i, scales, &vectors.values[i * sampled.rows]);
  return vectors;
}

/// What a basis chosen on `seen` leaves on `held_out`.
struct HeldOutFit {
  float residual = 0;               ///< on `seen`
  float worst = 0;                  ///< of all places, RMS over the rows
  std::vector<float> by_direction;  ///< RMS over places and channels
};
HeldOutFit fit_held_out(const ScaledVectors& seen, const ScaledVectors& held_out, float tolerance, int max_basis) {
  const BasisChoice choice = choose_basis({seen.values, seen.rows}, tolerance, max_basis);
  ReflectanceBasis basis(seen.rows);
  for (std::size_t b : choice.chosen) basis.add(seen[b]);
  const std::size_t places = seen.values.size() / seen.rows;
  HeldOutFit fit;
  fit.residual = choice.residual;
  fit.by_direction.resize(held_out.rows / 3);
  for (std::size_t i = 0; i < places; ++i) {
    BasisWeights weights;
    basis.fit(seen[i], weights);
    float sum = 0;
    for (int r = 0; r < held_out.rows; ++r) {
      float residual = held_out[i][r];
      for (std::size_t b = 0; b < choice.chosen.size(); ++b) residual -= weights[b] * held_out[choice.chosen[b]][r];
      sum += residual * residual;
      fit.by_direction[r / 3] += residual * residual;
    }
    fit.worst = std::max(fit.worst, std::sqrt(sum / static_cast<float>(held_out.rows)));
  }
  for (float& square : fit.by_direction) square = std::sqrt(square / static_cast<float>(3 * places));
  return fit;
}

void append(const DirectionPairs& from, std::size_t i, DirectionPairs& to) {
  DirectionPairs longer;
  longer.resize(to.size() + 1);
  for (std::size_t k = 0; k < longer.to_light.stride(); ++k) {
    // Padding repeats the first pair.
    const std::size_t at = k < longer.size() ? k : 0;
    const bool is_new = at == to.size();
    longer.to_light.set(k, is_new ? from.to_light.get(i) : to.to_light.get(at));
    longer.to_viewer.set(k, is_new ? from.to_viewer.get(i) : to.to_viewer.get(at));
  }
  to = std::move(longer);
}

}  // namespace

DirectionPairs held_out_samples(std::uint64_t seed) {
  Random random(hash64(seed, 31));
  DirectionPairs pairs;
  pairs.resize(kHeldOut);
  for (std::size_t i = 0; i < pairs.to_light.stride(); ++i) {
    const Vec3 light = random_direction(random), offset = random_direction(random);
    Vec3 viewer = random_direction(random);
    if (i % 2 == 0) {
      viewer = normalized(Vec3{-light.x, -light.y, light.z} + Vec3{offset.x, offset.y, 0} * kNearMirror);
      viewer.z = std::max(viewer.z, 0.05f), viewer = normalized(viewer);
    }
    pairs.to_light.set(i, light), pairs.to_viewer.set(i, viewer);
  }
  return pairs;
}

DirectionChoice choose_directions(const BoundPatterns& patterns, float tolerance, int max_basis) {
  DirectionChoice choice{reflection_samples()};
  for (int round = 0; round <= kRounds; ++round) {
    const DirectionPairs held_out = held_out_samples(round);
    const HeldOutFit fit = fit_held_out(sample_scaled(patterns, choice.directions), sample_scaled(patterns, held_out),
                                        tolerance, max_basis);
    choice.disagreement = fit.worst;
    if (round == 0) choice.disagreement_of_table = fit.worst;
    // Where the basis does not even hold in the directions it was chosen by, more of them change nothing.
    if (fit.residual > tolerance || fit.worst <= kDisagreement * tolerance || round == kRounds) return choice;
    std::vector<std::size_t> order(held_out.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::ranges::stable_sort(order, std::greater(), [&](std::size_t d) { return fit.by_direction[d]; });
    for (int k = 0; k < kAddedAtOnce; ++k, ++choice.added) append(held_out, order[k], choice.directions);
  }
  return choice;
}

}  // namespace redmap
