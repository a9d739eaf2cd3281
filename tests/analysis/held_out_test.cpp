// Directions beside the paper's table are added where it is blind, and nowhere else.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "analysis/basis.h"
#include "analysis/held_out.h"
#include "analysis/sampling.h"

namespace redmap {
namespace {

/// Lambert's, and on every second place a highlight off the plane of incidence, a quarter turn from the light and only
/// away from the normal: nowhere that the table looks.
class OffSpecular final : public BoundPatterns {
 public:
  OffSpecular(std::size_t size, float highlight) : size_(size), highlight_(highlight) {}
  std::size_t size() const override { return size_; }
  void radiance_each(const DirectionPairs& pairs, Planes<3>& out) const override {
    out.resize(size_);
    for (std::size_t i = 0; i < size_; ++i) set(i, pairs, i, out);
  }
  void radiance_one(std::size_t pattern, const DirectionPairs& pairs, Planes<3>& out) const override {
    out.resize(pairs.size());
    for (std::size_t i = 0; i < pairs.size(); ++i) set(pattern, pairs, i, out);
  }
  void radiance_all(const DirectionPairs& pairs, LaneVector<float>& out) const override {
    const std::size_t stride = padded(size_);
    out.resize(3 * pairs.size() * stride);
    for (std::size_t pair = 0; pair < pairs.size(); ++pair)
      for (std::size_t i = 0; i < size_; ++i)
        for (int c = 0; c < 3; ++c) out[(3 * pair + c) * stride + i] = value(i, pairs, pair);
  }
  void transmittance(Planes<3>& out) const override { out = Planes<3>(size_); }
  void emission(Planes<3>& out) const override { out = Planes<3>(size_); }
  bool materials(Materials&) const override { return false; }

 private:
  float value(std::size_t pattern, const DirectionPairs& pairs, std::size_t i) const {
    const Vec3 light = pairs.to_light.get(i), viewer = pairs.to_viewer.get(i);
    const Vec3 offset = viewer - Vec3{-light.y, light.x, light.z};
    const float slant = light.x * light.x + light.y * light.y;
    const float lobe = slant * slant * std::exp(-dot(offset, offset) / 0.1f);
    return light.z * (0.2f + (pattern % 2 ? highlight_ * lobe : 0.0f));
  }
  void set(std::size_t pattern, const DirectionPairs& pairs, std::size_t i, Planes<3>& out) const {
    for (int c = 0; c < 3; ++c) out[c][i] = value(pattern, pairs, i);
  }
  std::size_t size_;
  float highlight_;
};

std::size_t basis_size(const BoundPatterns& patterns, const DirectionPairs& directions) {
  const ReflectanceSampler sampler({}, directions);
  SampledReflectances sampled;
  sampler.sample(patterns, sampled);
  RowScaling scaling;
  scaling.add(sampled);
  std::vector<float> vectors(patterns.size() * sampler.rows());
  for (std::size_t i = 0; i < patterns.size(); ++i)
    scaled_reflectance(sampled, i, scaling.scales(), &vectors[i * sampler.rows()]);
  return choose_basis({vectors, sampler.rows()}, 0.025f, 8).chosen.size();
}

TEST(HeldOutDirections, FindAHighlightThatTheTableMisses) {
  const OffSpecular patterns(64, 3);
  EXPECT_EQ(basis_size(patterns, reflection_samples()), 1u);
  const DirectionChoice choice = choose_directions(patterns, 0.025f, 8);
  EXPECT_GT(choice.disagreement_of_table, 0.2f);
  EXPECT_GT(choice.added, 0);
  EXPECT_LT(choice.disagreement, 1e-3f);
  EXPECT_EQ(choice.directions.size(), reflection_samples().size() + choice.added);
  EXPECT_EQ(basis_size(patterns, choice.directions), 2u);
}

TEST(HeldOutDirections, AreNotNeededWhereTheTableSeesAll) {
  const DirectionChoice choice = choose_directions(OffSpecular(64, 0), 0.025f, 8);
  EXPECT_EQ(choice.added, 0);
  EXPECT_LT(choice.disagreement_of_table, 1e-5f);
}

TEST(HeldOutDirections, AreUnitVectorsAboveTheHorizon_OthersForEverySeed) {
  const DirectionPairs a = held_out_samples(1), b = held_out_samples(2);
  for (std::size_t i = 0; i < a.size(); ++i)
    for (const Vec3 d : {a.to_light.get(i), a.to_viewer.get(i)}) {
      EXPECT_NEAR(length(d), 1, 1e-5f);
      EXPECT_GT(d.z, 0);
    }
  EXPECT_NE(a.to_light.get(0), b.to_light.get(0));
}

}  // namespace
}  // namespace redmap
