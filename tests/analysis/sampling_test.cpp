// Sampled reflectances: the directions, the rows, and the few that stay distinct.
#include "analysis/sampling.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <vector>

#include "analysis/unique_reflectances.h"
#include "base/random.h"

namespace redmap {
namespace {

/// Lambert surfaces of given colours; the transmittance is a tenth of the colour, the emission a hundredth.
class LambertPatterns : public BoundPatterns {
 public:
  explicit LambertPatterns(std::vector<Rgb> colours) : colours_(std::move(colours)) {}
  std::size_t size() const override { return colours_.size(); }
  void radiance_each(const DirectionPairs&, Planes<3>&) const override {}
  void radiance_one(std::size_t, const DirectionPairs&, Planes<3>&) const override {}
  void radiance_all(const DirectionPairs& pairs, LaneVector<float>& out) const override {
    out.assign(pairs.size() * 3 * padded(size()), 99.0f);
    for (std::size_t p = 0; p < pairs.size(); ++p)
      for (std::size_t i = 0; i < size(); ++i) {
        const Rgb c = colours_[i] * (pairs.to_viewer[2][p] > 0 ? std::max(0.0f, pairs.to_light[2][p]) / kPi : 0.0f);
        float* at = &out[p * 3 * padded(size()) + i];
        at[0] = c.r, at[padded(size())] = c.g, at[2 * padded(size())] = c.b;
      }
  }
  void transmittance(Planes<3>& out) const override { fill(out, 0.1f); }
  void emission(Planes<3>& out) const override { fill(out, 0.01f); }
  bool materials(Materials&) const override { return false; }

 private:
  void fill(Planes<3>& out, float factor) const {
    out.resize(size());
    for (std::size_t i = 0; i < size(); ++i)
      out[0][i] = factor * colours_[i].r, out[1][i] = factor * colours_[i].g, out[2][i] = factor * colours_[i].b;
  }
  std::vector<Rgb> colours_;
};

SampledReflectances sample(const std::vector<Rgb>& colours, bool transmits, bool emits) {
  ShaderInfo info;
  info.transmits = transmits, info.emits = emits;
  SampledReflectances sampled;
  ReflectanceSampler(info).sample(LambertPatterns(colours), sampled);
  return sampled;
}

TEST(Directions, AreThoseOfThePapersTable) {
  const DirectionPairs pairs = reflection_samples();
  ASSERT_EQ(pairs.size(), 34u);
  const auto degrees = [](float cosine) { return std::acos(std::clamp(cosine, -1.0f, 1.0f)) * 180 / kPi; };
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    EXPECT_NEAR(length(pairs.to_light.get(i)), 1, 1e-6f);
    EXPECT_NEAR(length(pairs.to_viewer.get(i)), 1, 1e-6f);
  }
  // The first line looks along the normal; line 7, (30, 30, 180), is a mirror pair; line 11 is (30, 40, 180).
  EXPECT_NEAR(degrees(pairs.to_viewer[2][0]), 0, 0.1f);
  EXPECT_NEAR(pairs.to_light.get(6).x, -pairs.to_viewer.get(6).x, 1e-6f);
  EXPECT_NEAR(degrees(pairs.to_light[2][10]), 30, 0.01f);
  EXPECT_NEAR(degrees(pairs.to_viewer[2][10]), 40, 0.01f);
  EXPECT_NEAR(degrees(dot(pairs.to_light.get(33), pairs.to_viewer.get(33))), 160, 0.01f);
}

TEST(Sampling, Rows_AreReflections_ThenTransmittance_ThenEmission) {
  const std::vector<Rgb> colours{{1, 0.5f, 0.25f}, {0.1f, 0.2f, 0.3f}};
  const SampledReflectances opaque = sample(colours, false, false);
  EXPECT_EQ(opaque.rows, 105);
  EXPECT_FLOAT_EQ(opaque.row(1)[0], 0.5f / kPi);
  EXPECT_NEAR(opaque.row(3 * 6 + 2)[1], 0.3f * std::cos(kPi / 6) / kPi, 1e-6f);
  for (int r = 102; r < 105; ++r) EXPECT_EQ(opaque.row(r)[1], 0);

  const SampledReflectances all = sample(colours, true, true);
  EXPECT_EQ(all.rows, 108);
  EXPECT_FLOAT_EQ(all.row(102)[0], 0.1f);
  EXPECT_FLOAT_EQ(all.row(107)[1], 0.003f);
}

TEST(Sampling, FirstUnsoundPlace_IsFoundInAnyRow) {
  SampledReflectances sampled = sample(std::vector<Rgb>(13, Rgb{1, 0.5f, 0.25f}), true, true);
  // Padding may hold anything.
  for (int r = 0; r < sampled.rows; ++r) sampled.row(r)[13] = std::nanf("");
  EXPECT_FALSE(find_unsound_place(sampled));
  sampled.row(3)[12] = -std::numeric_limits<float>::infinity();
  EXPECT_EQ(find_unsound_place(sampled), 12u);
  sampled.row(107)[8] = std::nanf("");
  EXPECT_EQ(find_unsound_place(sampled), 8u);
  sampled.row(0)[2] = 2e18f, sampled.row(0)[1] = -1e18f;
  EXPECT_EQ(find_unsound_place(sampled), 2u);
}

TEST(RowScaling, BringsRowsToUnitRms_AndGivesZeroRowsTheBrightestOnesScale) {
  const SampledReflectances sampled = sample({{1, 0.5f, 0}, {0.2f, 0.1f, 0}, {0.7f, 0.3f, 0}}, false, false);
  RowScaling scaling;
  scaling.add(sampled);
  const std::vector<float> scales = scaling.scales();
  for (int r = 0; r < sampled.rows; ++r) {
    double square = 0;
    for (std::size_t i = 0; i < sampled.places; ++i) square += std::pow(scales[r] * sampled.row(r)[i], 2);
    EXPECT_NEAR(square / 3, sampled.row(r)[0] > 0 ? 1 : 0, 1e-5) << "row " << r;
  }
  EXPECT_EQ(scales[2], *std::min_element(scales.begin(), scales.end()));  // no blue
}

TEST(ReflectanceKeys, EqualOnesShareAKey_OthersDoNot) {
  std::vector<Rgb> colours;
  for (int i = 0; i < 300; ++i) colours.push_back(i % 2 ? Rgb{0.5f, 0.4f, 0.1f} : Rgb{0.49f, 0.4f, 0.1f});
  const SampledReflectances sampled = sample(colours, false, false);
  RowScaling scaling;
  scaling.add(sampled);
  std::vector<std::uint64_t> keys;
  LaneVector<float> sums;
  ReflectanceKeys(scaling.scales()).compute(sampled, keys, sums);
  EXPECT_EQ(std::set<std::uint64_t>(keys.begin(), keys.end()).size(), 2u);
  for (std::size_t i = 2; i < keys.size(); ++i) EXPECT_EQ(keys[i], keys[i - 2]);
}

TEST(UniqueReflectances, KeepTheSameSubset_ForAnyOrder) {
  const int distinct = 5000;
  const std::size_t capacity = 500;
  std::vector<std::uint64_t> keys;
  for (int i = 0; i < 2 * distinct; ++i) keys.push_back(hash64(i % distinct));
  std::vector<std::vector<std::uint64_t>> kept;
  for (int round = 0; round < 2; ++round) {
    UniqueReflectances unique(1, capacity);
    for (std::uint64_t key : keys) {
      const float value = unit_float(key);
      unique.insert(key, &value, {});
    }
    unique.finish();
    ASSERT_EQ(unique.size(), capacity);
    EXPECT_NEAR(unique.distinct(), distinct, 0.15 * distinct);
    kept.emplace_back();
    for (std::size_t i = 0; i < unique.size(); ++i) {
      kept.back().push_back(unique.key(i));
      EXPECT_EQ(*unique.scaled(i), unit_float(unique.key(i)));
    }
    std::reverse(keys.begin(), keys.end());
  }
  EXPECT_EQ(kept[0], kept[1]);
}

}  // namespace
}  // namespace redmap
