// Choosing a basis among planted mixtures: what was planted comes back.
#include "analysis/basis.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <vector>

#include "base/parallel.h"
#include "base/random.h"

namespace redmap {
namespace {

constexpr int kRows = 105;
constexpr float kTolerance = 0.025f;

/// Vectors of unit RMS rows, so that residuals mean what they mean in a bake.
struct Vectors {
  std::vector<float> values;
  void add(const std::vector<float>& v) { values.insert(values.end(), v.begin(), v.end()); }
  ReflectanceVectors view() const { return {values, kRows}; }
};

std::vector<float> random_vector(Random& random) {
  std::vector<float> v(kRows);
  for (float& x : v) x = 2 * random.next_float();
  return v;
}

std::vector<float> mixture(const std::vector<std::vector<float>>& pure, const std::vector<float>& weights) {
  std::vector<float> v(kRows);
  for (std::size_t i = 0; i < pure.size(); ++i)
    for (int r = 0; r < kRows; ++r) v[r] += weights[i] * pure[i][r];
  return v;
}

/// `pure` reflectances, each once at a random index, among convex mixtures of them.
struct Planted {
  Vectors vectors;
  std::vector<std::vector<float>> pure;
  std::set<std::size_t> pure_indices;
};

Planted plant(int pure_count, int mixtures, std::uint64_t seed) {
  Planted planted;
  Random random(seed);
  std::vector<std::vector<float>> all;
  for (int i = 0; i < pure_count; ++i) planted.pure.push_back(random_vector(random));
  for (int i = 0; i < mixtures; ++i) {
    std::vector<float> weights(pure_count);
    float sum = 0;
    for (float& w : weights) sum += w = random.next_float() * 0.9f + 0.01f;
    for (float& w : weights) w *= 0.95f / sum;
    all.push_back(mixture(planted.pure, weights));
  }
  for (const auto& p : planted.pure)
    all.insert(all.begin() + random.below(static_cast<std::uint32_t>(all.size() + 1)), p);
  for (std::size_t i = 0; i < all.size(); ++i) {
    planted.vectors.add(all[i]);
    if (std::find(planted.pure.begin(), planted.pure.end(), all[i]) != planted.pure.end())
      planted.pure_indices.insert(i);
  }
  return planted;
}

TEST(ChooseBasis, RedAndGreenTexels_SelectRedAndGreen_NeverYellow) {
  // A third of the texels mix red and green half and half: yellow is the mean, and what PCA would begin with.
  Vectors vectors;
  std::vector<float> red(kRows), green(kRows), yellow(kRows);
  for (int r = 0; r < kRows; ++r) {
    red[r] = r % 3 == 0 ? 1.5f : 0.0f;
    green[r] = r % 3 == 1 ? 1.5f : 0.0f;
    yellow[r] = 0.5f * (red[r] + green[r]);
  }
  for (int i = 0; i < 30; ++i) vectors.add(i % 3 == 0 ? yellow : i % 3 == 1 ? red : green);
  const BasisChoice choice = choose_basis(vectors.view(), kTolerance, 8);
  ASSERT_EQ(choice.chosen.size(), 2u);
  for (std::size_t i : choice.chosen) EXPECT_NE(i % 3, 0u);
  EXPECT_LT(choice.residual, 1e-5f);
}

TEST(ChooseBasis, FindsThePlantedOnes_AndOnlyThem) {
  for (int count : {1, 2, 3, 5, 8}) {
    const Planted planted = plant(count, 600, 100 + count);
    const BasisChoice choice = choose_basis(planted.vectors.view(), kTolerance, 16);
    EXPECT_EQ(std::set<std::size_t>(choice.chosen.begin(), choice.chosen.end()), planted.pure_indices);
    EXPECT_LT(choice.residual, 1e-4f);
  }
}

TEST(ChooseBasis, DependsNeitherOnTheOrderOfVectors_NorOnThreads) {
  const Planted planted = plant(4, 999, 3);
  std::set<std::vector<float>> expected(planted.pure.begin(), planted.pure.end());
  std::vector<std::size_t> order(planted.vectors.view().size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  Random random(6);
  for (std::size_t threads : {1, 2, 7}) {
    const ThreadLimit limit(threads);
    for (std::size_t i = order.size() - 1; i > 0; --i)
      std::swap(order[i], order[random.below(static_cast<std::uint32_t>(i + 1))]);
    Vectors shuffled;
    for (std::size_t i : order) {
      const float* v = planted.vectors.view()[i];
      shuffled.add({v, v + kRows});
    }
    const BasisChoice choice = choose_basis(shuffled.view(), kTolerance, 16);
    std::set<std::vector<float>> chosen;
    for (std::size_t i : choice.chosen) chosen.insert({shuffled.view()[i], shuffled.view()[i] + kRows});
    EXPECT_EQ(chosen, expected);
  }
}

TEST(ChooseBasis, StopsAtTheLargestAllowed_AndReportsWhatIsLeft) {
  const Planted planted = plant(6, 100, 5);
  const BasisChoice choice = choose_basis(planted.vectors.view(), kTolerance, 3);
  ASSERT_EQ(choice.chosen.size(), 3u);
  ReflectanceBasis basis(kRows);
  for (std::size_t i : choice.chosen) basis.add(planted.vectors.view()[i]);
  float largest = 0;
  BasisWeights weights;
  for (std::size_t i = 0; i < planted.vectors.view().size(); ++i)
    largest = std::max(largest, basis.fit(planted.vectors.view()[i], weights));
  EXPECT_GT(choice.residual, kTolerance);
  EXPECT_FLOAT_EQ(choice.residual, largest);
}

TEST(ChooseBasis, KeepsWhatItIsToldToStartFrom) {
  const Planted planted = plant(3, 50, 9);
  std::vector<std::size_t> start;
  for (std::size_t i = 0; i < planted.vectors.view().size() && start.empty(); ++i)
    if (!planted.pure_indices.contains(i)) start.push_back(i);
  const BasisChoice choice = choose_basis(planted.vectors.view(), kTolerance, 16, start);
  EXPECT_EQ(choice.chosen.front(), start.front());
  EXPECT_EQ(choice.chosen.size(), 4u);
  EXPECT_LT(choice.residual, kTolerance);
}

TEST(ChooseBasis, BlackSurface_HasABasisOfOne) {
  Vectors vectors;
  vectors.add(std::vector<float>(kRows));
  const BasisChoice choice = choose_basis(vectors.view(), kTolerance, 8);
  EXPECT_EQ(choice.chosen.size(), 1u);
  EXPECT_EQ(choice.residual, 0);
}

TEST(ReflectanceBasis, WhatIsNoNumber_IsInfinitelyFar) {
  Random random(13);
  std::vector<float> v = random_vector(random);
  ReflectanceBasis basis(kRows);
  basis.add(v.data());
  BasisWeights weights;
  v[77] = std::nanf("");
  EXPECT_EQ(basis.fit(v.data(), weights), std::numeric_limits<float>::infinity());
}

TEST(ReflectanceBasis, Fit_RecoversPlantedWeights_AndTheirDistance) {
  Random random(12);
  ReflectanceBasis basis(kRows);
  std::vector<std::vector<float>> pure;
  for (int i = 0; i < 5; ++i) {
    pure.push_back(random_vector(random));
    basis.add(pure.back().data());
  }
  const std::vector<float> planted{0.5f, 0, 0.25f, 1.5f, 0};
  const std::vector<float> v = mixture(pure, planted);
  BasisWeights weights;
  EXPECT_LT(basis.fit(v.data(), weights), 1e-5f);
  for (int i = 0; i < 5; ++i) EXPECT_NEAR(weights[i], planted[i], 1e-4f);

  const BasisWeights zero{};
  double square = 0;
  for (float x : v) square += static_cast<double>(x) * x;
  EXPECT_NEAR(basis.distance(weights.data(), zero.data()), std::sqrt(square / kRows), 1e-4);
  basis.remove(3);
  EXPECT_GT(basis.fit(v.data(), weights), 0.1f);
}

}  // namespace
}  // namespace redmap
