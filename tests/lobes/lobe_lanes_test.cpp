// Closed-form integrals against brute force, lane by lane.
#include "lobes/lobe_lanes.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/random.h"
#include "base/vec.h"

namespace redmap {
namespace {

/// A cosine and two Gaussians, the same at all angles.
LobeModel model_of(int narrow, int wide) {
  LobeModel model;
  for (LobeModel::Angle& angle : model.angles) {
    angle.constant = {0.02f, 0.01f, 0};
    angle.cosine = {0.3f, 0.2f, 0.1f};
    angle.amplitude[narrow] = {2, 1, 0.5f};
    angle.amplitude[wide] = {0.1f, 0.2f, 0.3f};
    angle.stretch = 0.8f;
  }
  return model;
}

struct Case {
  Vec3 to_light, to_viewer;
  NormalLanes normals;  ///< the same in all lanes
};

Case random_case(Random& random) {
  const auto direction = [&] {
    return normalized({1.2f * random.next_float() - 0.6f, 1.2f * random.next_float() - 0.6f, 1});
  };
  const float s1 = 0.02f + 0.15f * random.next_float(), s2 = s1 * (0.3f + 0.7f * random.next_float());
  const float turn = 3 * random.next_float(), c = std::cos(turn), s = std::sin(turn);
  return {direction(),
          direction(),
          {0.3f * random.next_float() - 0.15f, 0.3f * random.next_float() - 0.15f, s1 * s1 * c * c + s2 * s2 * s * s,
           (s1 * s1 - s2 * s2) * c * s, s1 * s1 * s * s + s2 * s2 * c * c}};
}

Vec3Lanes lanes_of(Vec3 v) { return {v.x, v.y, v.z}; }

/// Mean of the model over the distribution, by 64 x 64 normals.
std::array<double, 3> brute_force(const LobeModel& model, const Case& c) {
  const WidthsInUse in_use = widths_in_use(model);
  const HalfVectorLanes half = half_vector(lanes_of(c.to_light), lanes_of(c.to_viewer));
  const LobeLanes lobes = lobes_at(model, in_use, half.theta_degrees);
  const float xx = c.normals.xx.v[0], xy = c.normals.xy.v[0], yy = c.normals.yy.v[0];
  const float l11 = std::sqrt(xx), l21 = xy / l11, l22 = std::sqrt(yy - l21 * l21);
  constexpr int kStrata = 64;
  std::array<double, 3> sum{};
  for (int i = 0; i < kStrata; ++i)
    for (int j = 0; j < kStrata; ++j) {
      const float radius = std::sqrt(-2 * std::log(1 - (static_cast<float>(i) + 0.5f) / kStrata));
      const float angle = 2 * kPi * (static_cast<float>(j) + 0.5f) / kStrata;
      const float a = radius * std::cos(angle), b = radius * std::sin(angle);
      const float x = c.normals.x.v[0] + l11 * a, y = c.normals.y.v[0] + l21 * a + l22 * b;
      const Vec3 n{x, y, std::sqrt(std::max(0.0f, 1 - x * x - y * y))};
      const LobeValue value = at_normal(in_use, lobes, half, lanes_of(n));
      for (int k = 0; k < 3; ++k) sum[k] += (value.highlight[k].v[0] + value.smooth[k].v[0]) / (kStrata * kStrata);
    }
  return sum;
}

TEST(LobeIntegral, AgreesWithBruteForce_ForRandomDistributions) {
  const LobeModel model = model_of(4, 7);
  const WidthsInUse in_use = widths_in_use(model);
  Random random(1);
  double error = 0, scale = 0;
  for (int i = 0; i < 200; ++i) {
    const Case c = random_case(random);
    const HalfVectorLanes half = half_vector(lanes_of(c.to_light), lanes_of(c.to_viewer));
    const LobeLanes lobes = lobes_at(model, in_use, half.theta_degrees);
    LobeSums sums;
    add_distribution(in_use, lobes, half, c.normals, 1.0f, sums);
    const LobeValue value = integral(in_use, lobes, sums);
    const auto expected = brute_force(model, c);
    for (int k = 0; k < 3; ++k) {
      const double found = value.highlight[k].v[3] + value.smooth[k].v[3];
      error += (found - expected[k]) * (found - expected[k]);
      scale += expected[k] * expected[k];
    }
  }
  EXPECT_LT(std::sqrt(error / scale), 0.01);
}

TEST(LobeIntegral, OfNoSpread_IsTheModelItself) {
  const LobeModel model = model_of(4, 7);
  const WidthsInUse in_use = widths_in_use(model);
  Random random(2);
  for (int i = 0; i < 50; ++i) {
    Case c = random_case(random);
    c.normals.xx = c.normals.xy = c.normals.yy = 0.0f;
    const HalfVectorLanes half = half_vector(lanes_of(c.to_light), lanes_of(c.to_viewer));
    const LobeLanes lobes = lobes_at(model, in_use, half.theta_degrees);
    LobeSums sums;
    add_distribution(in_use, lobes, half, c.normals, 0.5f, sums);
    const LobeValue value = integral(in_use, lobes, sums);
    const float x = c.normals.x.v[0], y = c.normals.y.v[0];
    const LobeValue there = at_normal(in_use, lobes, half, lanes_of({x, y, std::sqrt(1 - x * x - y * y)}));
    for (int k = 0; k < 3; ++k) {
      EXPECT_NEAR(value.highlight[k].v[0], 0.5f * there.highlight[k].v[0], 1e-4f);
      EXPECT_NEAR(value.smooth[k].v[0], 0.5f * there.smooth[k].v[0], 1e-4f);
    }
    EXPECT_FLOAT_EQ(sums.spread.v[0], 0);
  }
}

TEST(HalfVector, IsAnOrthonormalFrame_AlsoWhereLightAndViewerCoincideOrOppose) {
  for (const auto& [light, viewer] : {std::pair{Vec3{0, 0, 1}, Vec3{0, 0, 1}},
                                      {Vec3{1, 0, 0}, Vec3{-1, 0, 0}},
                                      {normalized({1, 2, 3}), normalized({-2, 1, 1})}}) {
    const HalfVectorLanes h = half_vector(lanes_of(light), lanes_of(viewer));
    const auto at = [](const Vec3Lanes& v) { return Vec3{v.x.v[0], v.y.v[0], v.z.v[0]}; };
    const Vec3 a = at(h.half), b = at(h.in_plane), c = at(h.across);
    for (const Vec3& v : {a, b, c}) EXPECT_NEAR(length(v), 1, 1e-4f);
    EXPECT_NEAR(dot(a, b), 0, 1e-4f);
    EXPECT_NEAR(dot(b, c), 0, 1e-4f);
    EXPECT_NEAR(dot(a, c), 0, 1e-4f);
  }
}

}  // namespace
}  // namespace redmap
