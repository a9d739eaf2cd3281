// Distributions of normals on every level: what is packed comes back, what is planted is found, area by area.
#include "map/normal_pyramid.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "base/random.h"

namespace redmap {
namespace {

TEST(PackedNormals, ComeBackWithinTheirSteps_AndZeroExactly) {
  Random random(3);
  for (int i = 0; i < 1000; ++i) {
    const float s1 = 0.002f * std::pow(200.0f, random.next_float()), s2 = s1 * random.next_float();
    const float turn = 3.14f * random.next_float(), c = std::cos(turn), s = std::sin(turn);
    const NormalGaussian n{1.6f * random.next_float() - 0.8f, 1.6f * random.next_float() - 0.8f,
                           s1 * s1 * c * c + s2 * s2 * s * s, (s1 * s1 - s2 * s2) * c * s,
                           s1 * s1 * s * s + s2 * s2 * c * c};
    const NormalGaussian back = unpack(pack(n));
    EXPECT_NEAR(back.x, n.x, 2.6e-4f);
    EXPECT_NEAR(back.y, n.y, 2.6e-4f);
    const float tolerance = 0.06f * s1 * s1 + 1e-6f;  // 2.8 % of a deviation, twice; and the smallest
    EXPECT_NEAR(back.xx, n.xx, tolerance);
    EXPECT_NEAR(back.xy, n.xy, tolerance);
    EXPECT_NEAR(back.yy, n.yy, tolerance);
  }
  const NormalGaussian flat = unpack(pack({}));
  for (float value : {flat.x, flat.y, flat.xx, flat.xy, flat.yy}) EXPECT_EQ(value, 0);
}

struct Planted {
  BaseLevel moments;
  WeightPyramid weights;
  NormalPyramid normals;
};

/// Normals of every texel by `normal`, weights of two basis reflectances by `weight`: first w, second 1 - w.
template <typename Normal, typename Weight>
Planted plant(Extent extent, const Normal& normal, const Weight& weight) {
  Planted p{BaseLevel(extent, NormalPyramid::kMoments, false), {}, {}};
  BaseLevel weights(extent, 2, false);
  for (int y = 0; y < extent.height; ++y)
    for (int x = 0; x < extent.width; ++x) {
      const std::size_t t = static_cast<std::size_t>(y) * extent.width + x;
      const Vec2 n = normal(x, y);
      const float values[] = {n.x, n.y, n.x * n.x, n.x * n.y, n.y * n.y};
      std::copy(std::begin(values), std::end(values), &p.moments.values[t * NormalPyramid::kMoments]);
      weights.values[2 * t] = weight(x, y), weights.values[2 * t + 1] = 1 - weight(x, y);
      p.moments.coverage[t] = weights.coverage[t] = 1;
    }
  p.weights = WeightPyramid(weights);
  p.normals = NormalPyramid(p.moments, p.weights);
  return p;
}

/// Moments over all distributions of hit 0, with the weights of one basis reflectance.
std::array<double, 6> moments_of(const NormalMixtures& m, std::size_t basis) {
  std::array<double, 6> sum{};
  for (std::uint32_t k = m.first[0]; k < m.first[1]; ++k) {
    const double w = m.weights[basis][k];
    sum[0] += w, sum[1] += w * m.x[k], sum[2] += w * m.y[k];
    sum[3] += w * (m.xx[k] + m.x[k] * m.x[k]), sum[4] += w * (m.xy[k] + m.x[k] * m.y[k]);
    sum[5] += w * (m.yy[k] + m.y[k] * m.y[k]);
  }
  return sum;
}

NormalMixtures gather(const Planted& p, Footprint footprint, float texels = 2) {
  NormalMixtures out = NormalMixtures::none(2);
  p.normals.gather({&footprint, 1}, p.weights, texels, out);
  return out;
}

TEST(NormalPyramid, ConstantNormals_StayConstantOnEveryLevel) {
  const Planted p = plant(
      {60, 44},
      [](int, int) {
        return Vec2{0.25f, -0.125f};
      },
      [](int, int) { return 0.5f; });
  for (float size : {0.01f, 0.1f, 0.5f, 1.0f}) {
    const auto m = moments_of(gather(p, {{0.5f, 0.5f}, {size, 0}, {0, size}}), 0);
    EXPECT_NEAR(m[0], 0.5, 0.005) << size;
    EXPECT_NEAR(m[1] / m[0], 0.25, 3e-4) << size;
    EXPECT_NEAR(m[2] / m[0], -0.125, 3e-4) << size;
    EXPECT_NEAR(m[3] / m[0] - 0.0625, 0, 4e-4) << size;
  }
}

TEST(NormalPyramid, MomentsOverAFootprint_AreThoseOfItsTexels_WithTheirWeights) {
  // Shiny texels lean one way, dull ones the other.
  Random random(5);
  std::vector<float> noise(64 * 64);
  for (float& v : noise) v = 0.1f * (random.next_float() - 0.5f);
  const auto shiny = [](int x, int) { return x / 3 % 2 ? 1.0f : 0.0f; };
  const Planted p = plant(
      {64, 64},
      [&](int x, int y) {
        return Vec2{(shiny(x, y) > 0 ? 0.3f : -0.2f) + noise[y * 64 + x], 0.0f};
      },
      shiny);
  for (int size : {16, 32, 64}) {
    // A footprint that is exactly size x size texels, from (0, 0).
    const float side = static_cast<float>(size) / 64;
    const NormalMixtures found = gather(p, {{side / 2, side / 2}, {side, 0}, {0, side}});
    for (std::size_t basis : {0u, 1u}) {
      double w = 0, x = 0, xx = 0;
      for (int i = 0; i < size; ++i)
        for (int j = 0; j < size; ++j) {
          const float weight = basis == 0 ? shiny(i, j) : 1 - shiny(i, j);
          const float* m = &p.moments.values[(j * 64 + i) * NormalPyramid::kMoments];
          w += weight, x += weight * m[0], xx += weight * m[2];
        }
      const auto m = moments_of(found, basis);
      EXPECT_NEAR(m[0], w / (size * size), 0.01) << size;
      EXPECT_NEAR(m[1] / m[0], x / w, 0.02) << "size " << size << ", basis " << basis;
      EXPECT_NEAR(m[3] / m[0], xx / w, 0.01) << "size " << size << ", basis " << basis;
    }
  }
}

TEST(NormalPyramid, TexelsThatAreCut_GiveTheNormalsOfTheirPart_UnlessAnEdgeIsThere) {
  const auto mean_of = [](const NormalMixtures& m) {
    float sum = 0, weight = 0;
    for (std::uint32_t k = 0; k < m.first[1]; ++k) sum += m.weights[0][k] * m.x[k], weight += m.weights[0][k];
    return sum / weight;
  };
  // A ramp: its value anywhere is known, not only at the middle of texels.
  const Planted ramp = plant(
      {64, 64},
      [](int x, int) {
        return Vec2{0.01f * (static_cast<float>(x) - 32), 0};
      },
      [](int, int) { return 1.0f; });
  for (const float middle : {20.0f, 20.2f, 20.5f, 20.9f}) {
    const NormalMixtures m = gather(ramp, {{middle / 64, 0.5f}, {1.4f / 64, 0}, {0, 2.0f / 64}});
    EXPECT_NEAR(mean_of(m), 0.01f * (middle - 32.5f), 5e-4f) << middle;
  }
  // A step: both sides stay what they are.
  const Planted step = plant(
      {64, 64},
      [](int x, int) {
        return Vec2{x < 32 ? -0.3f : 0.3f, 0};
      },
      [](int, int) { return 1.0f; });
  const NormalMixtures m = gather(step, {{32.2f / 64, 0.5f}, {1.4f / 64, 0}, {0, 2.0f / 64}});
  for (std::uint32_t k = 0; k < m.first[1]; ++k) EXPECT_NEAR(std::abs(m.x[k]), 0.3f, 1e-3f);
}

TEST(NormalPyramid, TwoDirections_StayApart_WhereOneGaussianWouldMixThem) {
  const Planted p = plant(
      {64, 64},
      [](int x, int) {
        return Vec2{x % 2 ? 0.4f : -0.4f, 0};
      },
      [](int, int) { return 1.0f; });
  const NormalMixtures m = gather(p, {{0.5f, 0.5f}, {1, 0}, {0, 1}});
  for (std::uint32_t k = m.first[0]; k < m.first[1]; ++k) {
    EXPECT_NEAR(std::abs(m.x[k]), 0.4f, 0.01f);
    EXPECT_LT(m.xx[k], 1e-3f);
  }
}

TEST(NormalPyramid, BetweenLevels_NothingPops) {
  Random random(8);
  std::vector<Vec2> normals(128 * 128);
  for (Vec2& n : normals) n = {0.5f * (random.next_float() - 0.5f), 0.5f * (random.next_float() - 0.5f)};
  const Planted p = plant(
      {128, 128}, [&](int x, int y) { return normals[y * 128 + x]; }, [](int, int) { return 1.0f; });
  double last = -1;
  for (float size = 0.02f; size < 0.9f; size *= 1.01f) {
    const auto m = moments_of(gather(p, {{0.5f, 0.5f}, {size, 0}, {0, size}}), 0);
    const double variance = m[3] / m[0] + m[5] / m[0];
    if (last >= 0) {
      EXPECT_NEAR(variance, last, 0.05 * last) << size;
    }
    last = variance;
  }
}

TEST(NormalPyramid, FootprintsThatAreNoNumbers_OrReachFarBeyondTheMap_AnswerWithAllTheWeight) {
  const Planted p = plant(
      {64, 32},
      [](int, int) {
        return Vec2{0.1f, 0};
      },
      [](int, int) { return 0.5f; });
  const float nan = std::numeric_limits<float>::quiet_NaN(), infinity = std::numeric_limits<float>::infinity();
  for (const Footprint& footprint :
       {Footprint{{nan, 0.5f}, {0.1f, 0}, {0, 0.1f}}, Footprint{{0.5f, 0.5f}, {infinity, 0}, {0, 0.1f}},
        Footprint{{0.5f, 0.5f}, {1e12f, 0}, {0, 1e12f}}, Footprint{{1e12f, -1e12f}, {0.1f, 0}, {0, 0.1f}},
        Footprint{{0.5f, 0.5f}, {0, 0}, {0, 0}}}) {
    const auto m = moments_of(gather(p, footprint), 0);
    EXPECT_NEAR(m[0], 0.5, 0.005);
  }
}

TEST(NormalPyramid, BumpMappedBasisOfOne_TakesNoMoreThanThePapersMap) {
  BaseLevel moments({1024, 1024}, NormalPyramid::kMoments, false), weights({1024, 1024}, 1, false);
  std::fill(moments.coverage.begin(), moments.coverage.end(), 1.0f);
  std::fill(weights.coverage.begin(), weights.coverage.end(), 1.0f);
  std::fill(weights.values.begin(), weights.values.end(), 1.0f);
  const WeightPyramid pyramid(weights);
  const NormalPyramid normals(moments, pyramid);
  EXPECT_LE(static_cast<double>(pyramid.bytes() + normals.bytes()), 15.4e6);  // paper, section 6.3
}

}  // namespace
}  // namespace redmap
