// The baselines: averaged parameters and mean normals.
#include "bake/baselines.h"

#include <gtest/gtest.h>

#include "base/error.h"

namespace redmap {
namespace {

TEST(ParameterChannels, OneMaterial_ComesBackAsItWas) {
  Materials materials;
  materials.resize(2);
  materials.diffuse.set(0, Vec3{0.1f, 0.2f, 0.3f});
  materials.specular.set(0, Vec3{0.5f, 0.4f, 0.3f});
  materials.transmittance.set(0, Vec3{0.7f, 0.8f, 0.9f});
  materials.exponent[0][0] = 120;
  float channels[ParameterChannels::kCount];
  parameter_channels(materials, 0, channels);
  set_material(channels, 1, materials);
  EXPECT_EQ(materials.diffuse.get(1), materials.diffuse.get(0));
  EXPECT_EQ(materials.specular.get(1), materials.specular.get(0));
  EXPECT_EQ(materials.transmittance.get(1), materials.transmittance.get(0));
  EXPECT_NEAR(materials.exponent[0][1], 120, 0.01);
}

TEST(ParameterPyramid, WidensTheHighlight_BetweenGlossyAndDull) {
  const auto shader = make_library_shader("chrome_rubber");
  const Pyramid<float> pyramid = build_parameter_pyramid(*make_sphere(1), *shader, 64);
  EXPECT_EQ(pyramid.extent(0), (Extent{128, 64}));
  const auto exponent = [&](int level, int x, int y) {
    return pyramid.value(level, x, y, ParameterChannels::kSpecularLuminance) /
               pyramid.value(level, x, y, ParameterChannels::kWeightedRoughness) -
           2;
  };
  float lowest = 1e9f, highest = 0;
  for (int y = 0; y < 64; ++y)
    for (int x = 0; x < 128; ++x) {
      lowest = std::min(lowest, exponent(0, x, y));
      highest = std::max(highest, exponent(0, x, y));
    }
  const float mean = exponent(pyramid.levels() - 1, 0, 0);
  EXPECT_GT(mean, lowest);
  EXPECT_LT(mean, 0.5f * highest);
}

TEST(ParameterPyramid, NeedsAShaderWithMaterials) {
  EXPECT_THROW(build_parameter_pyramid(*make_sphere(1), *make_library_shader("toon_black_box"), 16), Error);
}

TEST(NormalPyramid, HoldsTheSpheresNormals_AndTheirMeans) {
  const Pyramid<float> pyramid = build_normal_pyramid(*make_sphere(2), 32);
  for (int y = 0; y < 32; ++y)
    for (int x = 0; x < 64; x += 5) {
      const float polar = (static_cast<float>(y) + 0.5f) * kPi / 32;
      EXPECT_NEAR(pyramid.value(0, x, y, 1), std::cos(polar), 1e-5);
    }
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(pyramid.value(pyramid.levels() - 1, 0, 0, c), 0, 1e-5);
}

}  // namespace
}  // namespace redmap
