// Bumps and the shading normals that shaders declare.
#include <gtest/gtest.h>

#include "shader/library_shader.h"
#include "shader/parameter_values.h"
#include "shader_test_support.h"

// Last, since it gives GLSL's type names their meaning; plain numbers are `real` from here on.
using real = float;
#include "shader/glsl.h"
namespace redmap::text {
namespace {
using namespace redmap::glsl;
#include "shader/library/include/frame.glsl"
#include "shader/library/snow_on_slopes.glsl"

// Snow on slopes again, as a black box that declares its shading normal.
vec3 radiance(Surface at, Parameters p, vec3 to_light, vec3 to_viewer) {
  Surface bumped = at;
  bumped.normal = shading_normal(at, p);
  bumped.tangent = normalize(at.tangent - bumped.normal * dot(bumped.normal, at.tangent));
  return radiance(pattern(at, p), to_shading_frame(bumped, to_light), to_shading_frame(bumped, to_viewer));
}
}  // namespace
}  // namespace redmap::text

namespace redmap {
namespace {

using glsl::Float;

Vec3 random_position(Random& random) { return test::random_unit(random) * (10 * random.next_float()); }

glsl::Vec3 everywhere(Vec3 v) { return {Float(v.x), Float(v.y), Float(v.z)}; }
Vec3 first_lane(const glsl::Vec3& v) { return {v.x.v[0], v.y.v[0], v.z.v[0]}; }

TEST(NoiseGradient, IsTheSlopeOfTheNoise) {
  // Central differences in single precision: half a thousandth leaves errors of about a thousandth.
  constexpr real kStep = 5e-3f;
  Random random(1);
  for (auto i = 0; i < 500; ++i) {
    const Vec3 p = random_position(random);
    const Vec3 slope = first_lane(text::noise_gradient(everywhere(p)));
    const Vec3 fbm_slope = first_lane(text::fbm_gradient(everywhere(p), 3));
    for (auto axis = 0; axis < 3; ++axis) {
      Vec3 low = p, high = p;
      low[axis] -= kStep, high[axis] += kStep;
      const real width = high[axis] - low[axis];
      const auto difference = [&](auto noise) {
        return (noise(everywhere(high)) - noise(everywhere(low))).v[0] / width;
      };
      EXPECT_NEAR(slope[axis], difference([](glsl::Vec3 at) { return text::gradient_noise(at); }), 2e-3f);
      EXPECT_NEAR(fbm_slope[axis], difference([](glsl::Vec3 at) { return text::fbm(at, 3); }), 1e-2f);
    }
  }
}

TEST(UnitBumps, HaveARootMeanSquareSlopeOfOneAlongASurface) {
  for (const auto octaves : {1, 3, 5}) {
    Random random(2);
    double sum = 0;
    constexpr auto kCount = 40000;
    for (auto i = 0; i < kCount; ++i) {
      const Vec3 normal = test::random_unit(random);
      const Vec3 slope = first_lane(text::unit_bumps(everywhere(random_position(random)), octaves));
      const Vec3 along = slope - normal * dot(normal, slope);
      sum += dot(along, along);
    }
    EXPECT_NEAR(std::sqrt(sum / kCount), 1, 0.05) << octaves;
  }
}

TEST(BumpedNormal, OfASlopeInTheSurface_LeansAgainstIt) {
  const Vec3 flat = first_lane(text::bumped_normal(everywhere({0, 0, 1}), everywhere({0, 0, 5})));
  EXPECT_EQ(flat, (Vec3{0, 0, 1}));
  const Vec3 leaning = first_lane(text::bumped_normal(everywhere({0, 0, 1}), everywhere({1, 0, 7})));
  EXPECT_NEAR(leaning.x, -std::sqrt(0.5f), 1e-6f);
  EXPECT_NEAR(leaning.z, std::sqrt(0.5f), 1e-6f);
}

TEST(ShadingNormals, AreUnitVectorsOnTheOuterSide_AndThereWhereDeclared) {
  for (const std::string& name : library_shader_names()) {
    const auto shader = make_library_shader(name);
    const SurfacePoints points = test::random_points(1003, 3);
    Planes<3> normals;
    ASSERT_EQ(shader->bind(points)->shading_normals(normals), shader->info().perturbs_normals) << name;
    if (!shader->info().perturbs_normals) continue;
    ASSERT_EQ(normals.size(), 1003u);
    real largest_tilt = 0;
    for (std::size_t i = 0; i < 1003; ++i) {
      const Vec3 normal = normals.get(i);
      EXPECT_NEAR(length(normal), 1, 1e-5f) << name;
      EXPECT_GT(dot(normal, points.normal.get(i)), 0.05f) << name;
      largest_tilt = std::max(largest_tilt, length(cross(normal, points.normal.get(i))));
    }
    EXPECT_GT(largest_tilt, 0.1f) << name << " has no bumps";
  }
}

TEST(ShadingNormals, AreIndependentOfLaneAndBatch) {
  for (const std::string& name : library_shader_names()) {
    const auto shader = make_library_shader(name);
    if (!shader->info().perturbs_normals) continue;
    const SurfacePoints points = test::random_points(37, 4);
    Planes<3> together, alone;
    shader->bind(points)->shading_normals(together);
    for (std::size_t i = 0; i < 37; ++i) {
      shader->bind(test::repeated(points, i, 1 + i % 11))->shading_normals(alone);
      EXPECT_EQ(alone.get(i % (1 + i % 11)), together.get(i)) << name;
    }
  }
}

TEST(BlackBoxWithShadingNormal, EqualsTheSplitForm_InItsShadingFrame) {
  const ShaderInfo& info = library_shader_info("snow_on_slopes");
  using Form = library::BlackBoxForm<glsl::Surface, glsl::Vec3, text::Parameters>;
  const library::LibraryShader<Form, glsl::Surface, glsl::Vec3, text::Parameters> shader(info,
                                                                                         parameter_values(info, {}));
  const SurfacePoints points = test::random_points(1000, 5);
  const DirectionPairs pairs = test::random_pairs(1000, 6);
  const auto black_box = shader.bind(points), split = make_library_shader("snow_on_slopes")->bind(points);
  Planes<3> found, expected;
  black_box->radiance_each(pairs, found), split->radiance_each(pairs, expected);
  for (std::size_t i = 0; i < 1000; ++i)
    for (auto c : {0, 1, 2}) EXPECT_NEAR(found[c][i], expected[c][i], 1e-4 * (1 + expected[c][i]));
  ASSERT_TRUE(black_box->shading_normals(found) && split->shading_normals(expected));
  for (std::size_t i = 0; i < 1000; ++i) EXPECT_LT(length(found.get(i) - expected.get(i)), 1e-5f);
}

}  // namespace
}  // namespace redmap
