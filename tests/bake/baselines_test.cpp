// The baselines: averaged parameters and mean normals.
#include "bake/baselines.h"

#include <gtest/gtest.h>

#include "base/error.h"
#include "map/slope_moments.h"

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

TEST(ParameterChannels, PhongAndGgxInHalves_KeepTheirWidths_EachWeightedByItsReflectance) {
  Materials materials;
  materials.resize(3);
  materials.specular.set(0, Vec3{0.1f, 0.1f, 0.1f}), materials.specular.set(1, Vec3{0.3f, 0.3f, 0.3f});
  materials.exponent[0][0] = 50;
  materials.ggx[0][1] = materials.grazing[0][1] = 1;
  materials.roughness.set(1, Vec3{0.04f, 0.01f, 0.16f});
  float half[2][ParameterChannels::kCount];
  for (std::size_t i = 0; i < 2; ++i) parameter_channels(materials, i, half[i]);
  for (int c = 0; c < ParameterChannels::kCount; ++c) half[0][c] = 0.5f * (half[0][c] + half[1][c]);
  set_material(half[0], 2, materials);
  EXPECT_NEAR(materials.specular[0][2], 0.2, 1e-6);
  EXPECT_NEAR(materials.ggx[0][2], 0.75, 1e-3);
  EXPECT_NEAR(materials.exponent[0][2], 50, 0.01);
  EXPECT_NEAR(materials.roughness[0][2], 0.04, 1e-6);
  EXPECT_NEAR(materials.roughness[1][2], 0.01, 1e-6);
  EXPECT_NEAR(materials.roughness[2][2], 0.16, 1e-6);
}

TEST(ParameterPyramid, WidensTheHighlight_BetweenGlossyAndDull) {
  const auto shader = make_library_shader("chrome_rubber");
  const Pyramid<float> pyramid = build_parameter_pyramid(*make_sphere(1), *shader, 64);
  EXPECT_EQ(pyramid.extent(0), (Extent{128, 64}));
  const auto exponent = [&](int level, int x, int y) {
    return pyramid.value(level, x, y, ParameterChannels::kLuminance) /
               pyramid.value(level, x, y, ParameterChannels::kPhongVariance) -
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

TEST(SlopePyramid, HoldsTheVarianceOfTheBumpsSlopes) {
  // The slope of hammered_metal is the root mean square of its slopes along the surface, and they have no direction.
  const auto shader = make_library_shader("hammered_metal", {{"slope", {0.3f}}, {"scale", {10}}});
  const Pyramid<float> pyramid = build_slope_pyramid(*make_sphere(1), *shader, 128);
  // Level 5 has 4 x 8 texels; those around the equator are as many bumps as make a good mean.
  double xx = 0, yy = 0, mean = 0;
  const int level = 5;
  for (int x = 0; x < 8; ++x)
    for (int y = 1; y < 3; ++y) {
      mean += pyramid.value(level, x, y, SlopeMoments::kMean) / 16;
      xx += pyramid.value(level, x, y, SlopeMoments::kSecond) / 16;
      yy += pyramid.value(level, x, y, SlopeMoments::kSecond + 2) / 16;
    }
  EXPECT_NEAR(mean, 0, 0.03);
  EXPECT_NEAR(std::sqrt(xx + yy), 0.3, 0.03);
  EXPECT_NEAR(xx / yy, 1, 0.2);
}

TEST(SlopePyramid, NeedsAShaderThatPerturbsNormals) {
  EXPECT_THROW(build_slope_pyramid(*make_sphere(1), *make_library_shader("noise"), 16), Error);
}

TEST(NormalPyramid, HoldsTheSpheresNormals_AndTheirMeans) {
  const Pyramid<float> pyramid = build_normal_pyramid(*make_sphere(2), *make_library_shader("white"), 32);
  for (int y = 0; y < 32; ++y)
    for (int x = 0; x < 64; x += 5) {
      const float polar = (static_cast<float>(y) + 0.5f) * kPi / 32;
      EXPECT_NEAR(pyramid.value(0, x, y, 1), std::cos(polar), 1e-5);
    }
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(pyramid.value(pyramid.levels() - 1, 0, 0, c), 0, 1e-5);
}

}  // namespace
}  // namespace redmap
