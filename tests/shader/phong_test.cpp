// The Phong reflectance against its analytic albedo.
#include <gtest/gtest.h>

#include "shader_test_support.h"

namespace redmap {
namespace {

/// Albedo for light from straight above: radiance of material `m` integrated over viewers, by the midpoint rule.
double albedo_from_above(float exponent, float diffuse, float specular) {
  constexpr int kSteps = 8192, kAzimuths = 8;
  Materials materials;
  DirectionPairs pairs;
  materials.resize(kSteps * kAzimuths), pairs.resize(kSteps * kAzimuths);
  for (int i = 0; i < kSteps; ++i)
    for (int j = 0; j < kAzimuths; ++j) {
      const auto at = static_cast<std::size_t>(i * kAzimuths + j);
      const float z = (static_cast<float>(i) + 0.5f) / kSteps, r = std::sqrt(1 - z * z);
      const float angle = 2 * kPi * (static_cast<float>(j) + 0.5f) / kAzimuths;
      pairs.to_light.set(at, Vec3{0, 0, 1});
      pairs.to_viewer.set(at, Vec3{r * std::cos(angle), r * std::sin(angle), z});
      materials.diffuse.set(at, Vec3{diffuse, diffuse, diffuse});
      materials.specular.set(at, Vec3{specular, specular, specular});
      materials.exponent[0][at] = exponent;
    }
  Planes<3> out;
  material_radiance_each(materials, pairs, out);
  double sum = 0;
  // Directions are uniform in solid angle; the lobe's own cosine at the viewer is what turns radiance into flux.
  for (std::size_t i = 0; i < out.size(); ++i) sum += static_cast<double>(out[0][i]) * pairs.to_viewer[2][i];
  return sum * 2 * static_cast<double>(kPi) / static_cast<double>(out.size());
}

TEST(Phong, DiffuseAlbedoIsTheDiffuseColour) { EXPECT_NEAR(albedo_from_above(10, 0.6f, 0), 0.6, 1e-5); }

TEST(Phong, LobeIsNormalised_AlbedoFromAboveIsTheSpecularColour) {
  // The integral of (e + 2) / 2 pi z^e z over the hemisphere is 1.
  for (const float exponent : {1.0f, 5.0f, 40.0f, 300.0f})
    EXPECT_NEAR(albedo_from_above(exponent, 0, 0.5f), 0.5, 2e-3) << exponent;
}

TEST(Phong, PeaksInTheMirrorDirection) {
  Materials materials;
  DirectionPairs pairs;
  materials.resize(1), pairs.resize(1);
  materials.specular.set(0, Vec3{1, 1, 1});
  materials.exponent[0][0] = 300;
  pairs.to_light.set(0, Vec3{0.6f, 0, 0.8f});
  pairs.to_viewer.set(0, Vec3{-0.6f, 0, 0.8f});
  Planes<3> out;
  material_radiance_each(materials, pairs, out);
  EXPECT_NEAR(out[0][0], 302 / (2 * kPi) * 0.8f, 1e-2f);
}

TEST(Phong, MaterialsOfPhongShadersReproduceTheirRadiance) {
  for (const char* name : {"scales", "stone", "marble", "checker", "transparent", "chrome_rubber", "wet_dry"}) {
    const auto bound = make_library_shader(name)->bind(test::random_points(200, 1));
    const DirectionPairs pairs = test::random_pairs(200, 2);
    Materials materials;
    Planes<3> expected, found;
    ASSERT_TRUE(bound->materials(materials));
    bound->radiance_each(pairs, expected);
    material_radiance_each(materials, pairs, found);
    for (std::size_t i = 0; i < 200; ++i)
      for (int c = 0; c < 3; ++c) EXPECT_NEAR(found[c][i], expected[c][i], 1e-5f * (1 + expected[c][i])) << name;
  }
}

}  // namespace
}  // namespace redmap
