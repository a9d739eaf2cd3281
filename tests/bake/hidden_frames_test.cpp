// Shaders that keep their shading frames to themselves bake as if they had declared them.
#include <gtest/gtest.h>

#include "analysis/hidden_frames.h"
#include "bake/bake.h"
#include "base/random.h"
#include "map/tangent_moments.h"
#include "shader/library_shader.h"

// Last, since it gives GLSL's type names their meaning; plain numbers are `real` from here on.
using real = float;
#include "shader/glsl.h"
namespace redmap::text {
namespace {
using namespace redmap::glsl;
using Surface = redmap::glsl::Surface;  // and not what is baked
#include "shader/library/include/bump.glsl"
#include "shader/library/include/frame.glsl"
#include "shader/library/include/ggx.glsl"
#include "shader/library/include/phong.glsl"

struct Parameters {
  float tilt;  // of the bumps
  float turn;  // of the grain
};

vec3 bumpy_normal(Surface at, Parameters p) {
  return bumped_normal(at.normal, p.tilt * unit_bumps(at.position * 3.0, 2));
}
vec3 turned_tangent(Surface at, Parameters p) {
  float angle = p.turn * gradient_noise(at.position * 2.0);
  return at.tangent * cos(angle) + cross(at.normal, at.tangent) * sin(angle);
}

// Isotropic about bumps where there is no grain.
vec3 radiance(Surface at, Parameters p, vec3 to_light, vec3 to_viewer) {
  vec3 tangent = turned_tangent(at, p);
  at.normal = bumpy_normal(at, p);
  at.tangent = normalize(tangent - at.normal * dot(at.normal, tangent));
  vec3 light = to_shading_frame(at, to_light);
  vec3 viewer = to_shading_frame(at, to_viewer);
  vec3 phong = phong_radiance(vec3(0.4), vec3(0.3), 40.0, light, viewer);
  vec3 brushed = ggx_anisotropic_lobe(vec3(0.5), vec2(0.1, 0.4), light, viewer) * visible_cosine(light, viewer);
  return mix(phong, brushed, bvec3(p.turn > 0.0));
}
}  // namespace
}  // namespace redmap::text

namespace redmap {
namespace {

using Form = library::BlackBoxForm<glsl::Surface, glsl::Vec3, text::Parameters>;
using HidingShader = library::LibraryShader<Form, glsl::Surface, glsl::Vec3, text::Parameters>;

HidingShader make_hiding_shader(real tilt, real turn) {
  static const ShaderInfo info = [] {
    ShaderInfo i;
    i.name = "hiding", i.black_box = true;
    for (const char* name : {"tilt", "turn"}) {
      ParameterInfo parameter;
      parameter.name = name;
      i.parameters.push_back(parameter);
    }
    return i;
  }();
  return {info, {{tilt}, {turn}}};
}

ReductionMap bake_small(const Shader& shader, BakeReport* report = nullptr) {
  BakeOptions options;
  options.size = 64;
  return bake(*make_sphere(1), shader, options, report);
}

SurfacePoints places(std::size_t count) {
  SurfacePoints points;
  points.resize(count);
  Random random(3);
  for (std::size_t i = 0; i < points.position.stride(); ++i) {
    const auto component = [&] { return 2 * random.next_float() - 1; };
    const Vec3 normal = normalized({component(), component(), component()});
    points.position.set(i, normal), points.normal.set(i, normal);
    points.tangent.set(i, make_frame(normal, {0, 1, 0}).x);
  }
  return points;
}

TEST(HiddenFrames, BumpsOfABlackBox_BecomeNormalsOfOneReflectance) {
  BakeReport report;
  const ReductionMap map = bake_small(make_hiding_shader(0.3f, 0), &report);
  EXPECT_TRUE(map.hides_frames);
  EXPECT_EQ(map.basis.size(), 1u);
  EXPECT_FALSE(map.normals.empty());
  EXPECT_GT(report.probed_normals, 64u * 128u);
  EXPECT_LT(static_cast<double>(report.normals_not_found), 0.01 * static_cast<double>(report.probed_normals));
}

TEST(HiddenFrames, WithoutBumpsThereIsNothingToFind) {
  BakeReport report;
  const ReductionMap map = bake_small(make_hiding_shader(0, 0), &report);
  EXPECT_FALSE(map.hides_frames);
  EXPECT_TRUE(map.normals.empty() && map.tangents.empty());
  EXPECT_EQ(report.probed_normals, 0u);
}

TEST(HiddenFrames, GrainOfABlackBox_BecomesTurnsOfOneReflectance) {
  BakeReport report;
  const ReductionMap map = bake_small(make_hiding_shader(0, 2), &report);
  EXPECT_EQ(report.probed_normals, 0u);
  EXPECT_TRUE(map.hides_frames);
  EXPECT_EQ(map.basis.size(), 1u);
  EXPECT_FALSE(map.tangents.empty());
}

TEST(HiddenFrames, RevealedPatterns_AreTheSameReflectanceEverywhere) {
  const HidingShader shader = make_hiding_shader(0.3f, 0);
  const SurfacePoints points = places(100);
  const RevealedShader revealed(shader, find_hidden_frames(shader, points));
  const auto patterns = revealed.bind(points);
  DirectionPairs pairs;
  pairs.resize(100);
  for (std::size_t i = 0; i < pairs.to_light.stride(); ++i) {
    pairs.to_light.set(i, normalized({0.3f, 0.1f, 1})), pairs.to_viewer.set(i, normalized({-0.25f, 0, 1}));
  }
  Planes<3> radiance;
  patterns->radiance_each(pairs, radiance);
  for (std::size_t i = 0; i < 100; ++i) EXPECT_NEAR(radiance[0][i], radiance[0][0], 1e-3f * radiance[0][0]) << i;
  // And asked one by one, or all together, they answer the same.
  Planes<3> one;
  LaneVector<real> all;
  patterns->radiance_one(7, pairs, one);
  patterns->radiance_all(pairs, all);
  EXPECT_EQ(one[1][3], radiance[1][7]);
  EXPECT_EQ(all[(3 * 5 + 2) * padded(100) + 7], radiance[2][7]);
}

TEST(HiddenFrames, LibraryShadersHideNone) {
  const SurfacePoints points = places(300);
  for (const std::string& name : library_shader_names()) {
    const HiddenFrames hidden = find_hidden_frames(*make_library_shader(name), points);
    EXPECT_FALSE(hidden.normals) << name;
    EXPECT_FALSE(hidden.tangents) << name;
  }
}

TEST(TangentMoments, GiveBackTheTurnsTheyWereTakenFrom) {
  for (const real degrees : {0.0f, 20.0f, 90.0f, 135.0f, 179.0f}) {
    const real angle = degrees * kPi / 180;
    real moments[TangentMoments::kCount];
    tangent_moments({std::cos(angle), std::sin(angle)}, moments);
    for (const Vec2 turn : turns_of(moments))
      EXPECT_NEAR(std::abs(turn.x * std::sin(angle) - turn.y * std::cos(angle)), 0, 1e-5f) << degrees;
  }
  // Two grains, 60 degrees apart, of half the area each.
  real a[2], b[2];
  tangent_moments({1, 0}, a), tangent_moments({0.5f, 0.8660254f}, b);
  const real mean[] = {(a[0] + b[0]) / 2, (a[1] + b[1]) / 2};
  const auto turns = turns_of(mean);
  EXPECT_NEAR(turns[0].y, 0, 1e-3f);
  EXPECT_NEAR(turns[1].x, 0.5f, 1e-3f);
}

}  // namespace
}  // namespace redmap
