#include "export/material_textures.h"

#include <gtest/gtest.h>

#include "export_test_support.h"

namespace redmap {
namespace {

float read(const Texture& coarse, const Texture& fine, int level, int x, int row, int channel) {
  const auto byte = [&](const Texture& t) {
    return static_cast<float>(t.levels[level].texel(x, row, 3)[channel]) / 255;
  };
  return byte(coarse) + byte(fine) / 256 - 1 / 510.f;
}

/// What an engine finds at a point between four texels of the base, or at a texel of the level above.
Covariance2 filtered(const NormalTextures& normals, int level, int x, int row, int width) {
  float mean[2] = {}, moments[3] = {};
  const float part = 1 / static_cast<float>(width * width);
  for (int j = 0; j < width; ++j)
    for (int i = 0; i < width; ++i) {
      for (int c = 0; c < 2; ++c)
        mean[c] += part * (2 * read(normals.normal, normals.normal_fine, level, x + i, row + j, c) - 1);
      for (int c = 0; c < 3; ++c)
        moments[c] += part * read(normals.moments, normals.moments_fine, level, x + i, row + j, c);
    }
  return {normals.scale * moments[0] - mean[0] * mean[0], normals.scale * (2 * moments[2] - 1) - mean[0] * mean[1],
          normals.scale * moments[1] - mean[1] * mean[1]};
}

TEST(NormalTextures, MomentsOfFourTexels_AreThoseOfTheOneAbove) {
  const ExportInput input = small_input("hammered_metal", 64);
  const NormalTextures normals = *normal_textures(*input.map);
  double largest = 0;
  for (int row = 4; row < 12; ++row)
    for (int x = 0; x < 16; ++x) {
      const Covariance2 four = filtered(normals, 0, 2 * x, 2 * row, 2), one = filtered(normals, 1, x, row, 1);
      // Merging into two Gaussians of twelve bits and logarithmic bytes loses a little.
      EXPECT_NEAR(four.xx, one.xx, 0.004f + 0.05f * one.xx) << x << ' ' << row;
      EXPECT_NEAR(four.yy, one.yy, 0.004f + 0.05f * one.yy) << x << ' ' << row;
      EXPECT_NEAR(four.xy, one.xy, 0.004f + 0.05f * one.xx) << x << ' ' << row;
      largest = std::max(largest, static_cast<double>(one.xx));
    }
  EXPECT_GT(largest, 0.02);
}

// Of glTF's roughness: the direction in which normals vary most is where a highlight is drawn out.
TEST(OneMaterial, Ridges_AreRougherAcross) {
  const ExportInput input = small_input("ridges", 64);
  const OneMaterial one = average_material(*input.map, input.fits);
  ASSERT_TRUE(one.anisotropy);
  const TextureLevel& level = one.anisotropy->levels[3];
  const std::uint8_t* texel = level.texel(level.extent.width / 2, level.extent.height / 2, 3);
  EXPECT_NEAR(texel[0], 128, 20);                              // not along the rows,
  EXPECT_GT(std::abs(static_cast<int>(texel[1]) - 128), 110);  // but up or down
  EXPECT_GT(texel[2], 100);
}

TEST(GrainTexture, OnlyShadersThatTurnTheirTangents_HaveOne) {
  EXPECT_FALSE(grain_texture(*small_input("hammered_metal").map));
  EXPECT_TRUE(grain_texture(*small_input("brushed_metal").map));
}

}  // namespace
}  // namespace redmap
