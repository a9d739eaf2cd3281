// Lobes over normals that vary: nil gives the shaders' own lobes back, and a little agrees with averaging over normals.
#include <gtest/gtest.h>

#include "shader_test_support.h"

namespace redmap {
namespace {

TEST(Materials, WithNormalsThatDoNotVary_ReproduceTheirShader) {
  for (const char* name : {"noise", "hammered_metal", "scratched_metal", "ridges", "snow_on_slopes", "raised_scales"}) {
    const auto bound = make_library_shader(name)->bind(test::random_points(400, 1));
    const DirectionPairs pairs = test::random_pairs(400, 2);
    Materials materials;
    Planes<3> expected, found;
    ASSERT_TRUE(bound->materials(materials));
    bound->radiance_each(pairs, expected);
    material_radiance_each(materials, pairs, found);
    for (std::size_t i = 0; i < 400; ++i)
      for (int c = 0; c < 3; ++c) EXPECT_NEAR(found[c][i], expected[c][i], 5e-5f * (1 + expected[c][i])) << name;
  }
}

/// One material of one specular lobe, `count` times.
Materials specular_materials(std::size_t count, float exponent, float alpha) {
  Materials materials;
  materials.resize(count);
  for (std::size_t i = 0; i < count; ++i) {
    materials.specular.set(i, Vec3{1, 1, 1});
    materials.exponent[0][i] = exponent;
    materials.ggx[0][i] = materials.grazing[0][i] = alpha > 0;
    materials.roughness.set(i, Vec3{alpha * alpha, 0, alpha * alpha});
  }
  return materials;
}

/// Means over normals with a Gaussian of `deviation` along x and y about z: radiance over the cosine at the light.
double mean_over_normals(const Materials& one, Vec2 deviation, Vec3 to_light, Vec3 to_viewer) {
  const std::size_t count = one.exponent.size();
  Random random(5);
  DirectionPairs pairs;
  pairs.resize(count);
  std::vector<float> cosine(count);
  for (std::size_t i = 0; i < count; ++i) {
    // Box and Muller's normal deviates.
    const float radius = std::sqrt(-2 * std::log(1 - random.next_float())), angle = 2 * kPi * random.next_float();
    const Vec3 normal = normalized({deviation.x * radius * std::cos(angle), deviation.y * radius * std::sin(angle), 1});
    const Frame frame = make_frame(normal, {1, 0, 0});
    pairs.to_light.set(i, frame.to_local(to_light));
    pairs.to_viewer.set(i, frame.to_local(to_viewer));
    cosine[i] = dot(normal, to_light);
  }
  Planes<3> out;
  material_radiance_each(one, pairs, out);
  double sum = 0;
  for (std::size_t i = 0; i < count; ++i) sum += static_cast<double>(out[0][i]) / cosine[i];
  return sum / static_cast<double>(count);
}

double widened(float exponent, float alpha, Vec2 deviation, Vec3 to_light, Vec3 to_viewer) {
  Materials materials = specular_materials(1, exponent, alpha);
  materials.normals.set(0, Vec3{deviation.x * deviation.x, 0, deviation.y * deviation.y});
  DirectionPairs pairs;
  pairs.resize(1);
  pairs.to_light.set(0, to_light), pairs.to_viewer.set(0, to_viewer);
  Planes<3> out;
  material_radiance_each(materials, pairs, out);
  return static_cast<double>(out[0][0]) / to_light.z;
}

// Half a million normals leave less than a hundredth of noise.
constexpr std::size_t kNormals = 500000;
const Vec3 kLights[] = {{0, 0, 1}, {0.5f, 0.1f, 0.8602f}, {-0.2f, 0.6f, 0.7746f}};

TEST(WidenedPhong, IsTheMeanOverNormals_AlongAndAcrossTheMirrorDirection) {
  const Materials materials = specular_materials(kNormals, 200, 0);
  for (const Vec2 deviation : {Vec2{0.05f, 0.05f}, Vec2{0.1f, 0.02f}, Vec2{0.01f, 0.08f}})
    for (Vec3 light : kLights)
      for (const Vec2 off : {Vec2{0, 0}, Vec2{0.1f, 0}, Vec2{0, 0.1f}, Vec2{-0.07f, 0.07f}}) {
        light = normalized(light);
        const Vec3 viewer = normalized(Vec3{-light.x + off.x, -light.y + off.y, light.z});
        const double expected = mean_over_normals(materials, deviation, light, viewer);
        EXPECT_NEAR(widened(200, 0, deviation, light, viewer), expected, 0.1 * expected + 0.1);
      }
}

TEST(WidenedGgx, IsAboutTheMeanOverNormals) {
  const Materials materials = specular_materials(kNormals, 0, 0.2f);
  for (const Vec2 deviation : {Vec2{0.1f, 0.1f}, Vec2{0.15f, 0.03f}})
    for (Vec3 light : kLights)
      for (const Vec2 off : {Vec2{0, 0}, Vec2{0.3f, 0}, Vec2{0, 0.3f}}) {
        light = normalized(light);
        const Vec3 viewer = normalized(Vec3{-light.x + off.x, -light.y + off.y, light.z});
        // GGX convolved with a Gaussian is no GGX: its tails are fatter than those of a wider one.
        const double expected = mean_over_normals(materials, deviation, light, viewer);
        EXPECT_NEAR(widened(0, 0.2f, deviation, light, viewer), expected, 0.3 * expected);
      }
}

}  // namespace
}  // namespace redmap
