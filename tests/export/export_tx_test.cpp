#include <OpenImageIO/texture.h>
#include <gtest/gtest.h>

#include "export/material_textures.h"
#include "export_test_support.h"

namespace redmap {
namespace {

class ExportTx : public testing::Test {
 protected:
  void SetUp() override {
    input_ = small_input("chrome_rubber");
    ExportFolder folder(folder_ / "tx");
    export_tx(input_, folder);
    folder.commit();
  }

  /// Channel `channel` of a texture at the middle of a texel of `level`, filtered over as much as that texel.
  float look_up(const std::string& name, const Texture& texture, int level, int x, int row, int channel) {
    const Extent extent = texture.levels[level].extent;
    const float s = (static_cast<float>(x) + 0.5f) / static_cast<float>(extent.width);
    const float t = (static_cast<float>(row) + 0.5f) / static_cast<float>(extent.height);
    OIIO::TextureOpt options;
    options.mipmode = OIIO::TextureOpt::MipModeOneLevel;
    options.interpmode = OIIO::TextureOpt::InterpBilinear;
    float found[4] = {};
    const std::string file = (folder_ / "tx" / name).string();
    const bool done = system_->texture(OIIO::ustring(file), options, s, t, 1.f / static_cast<float>(extent.width), 0, 0,
                                       1.f / static_cast<float>(extent.height), 4, found);
    EXPECT_TRUE(done) << system_->geterror();
    return found[channel];
  }

  TemporaryFolder folder_;
  ExportInput input_;
  // The shared one, which lives as long as the program: OpenImageIO 2.4 deletes others by the size of their base class.
  OIIO::TextureSystem* system_ = OIIO::TextureSystem::create(true);
};

TEST_F(ExportTx, EveryLevel_IsTheMapsOwn_InATextureSystem) {
  const Masks masks = mask_textures(*input_.map);
  const Texture& mask = masks.textures[1];
  for (int level = 0; level < 4; ++level) {
    const Extent extent = mask.levels[level].extent;
    for (int i = 0; i < 8; ++i) {
      const int x = (3 * i + 1) % extent.width, row = (5 * i + 1) % extent.height;
      const float expected = static_cast<float>(*mask.levels[level].texel(x, row, 1)) / 255;
      EXPECT_NEAR(look_up("mask01.tx", mask, level, x, row, 0), expected, 2e-3f) << level << ' ' << x << ' ' << row;
    }
  }
}

// What sets these levels apart from those that a texture system would make itself.
TEST_F(ExportTx, RoughnessFarAway_IsWiderThanTheMeanOfRoughness) {
  const OneMaterial one = average_material(*input_.map, input_.fits);
  const Texture& roughness = one.metallic_roughness;
  const TextureLevel& base = roughness.levels.front();
  double mean = 0;
  for (std::size_t i = 1; i < base.texels.size(); i += 3) mean += base.texels[i];
  mean /= 255.0 * static_cast<double>(base.texels.size() / 3);
  const int last = static_cast<int>(roughness.levels.size()) - 1;
  const float far = static_cast<float>(roughness.levels[last].texel(0, 0, 3)[1]) / 255;
  float least = 1, most = 0;
  for (const MaterialFit& fit : input_.fits)
    least = std::min(least, fit.material.roughness), most = std::max(most, fit.material.roughness);
  EXPECT_GT(far, least + 0.01f);
  EXPECT_LT(far, most + 0.01f);
  EXPECT_GT(std::abs(static_cast<double>(far) - mean), 0.01);
  EXPECT_NEAR(look_up("metallic_roughness.tx", roughness, last, 0, 0, 1), far, 2e-3f);
}

TEST(ExportFolder, FailedExport_LeavesTheEarlierOneAsItWas) {
  const TemporaryFolder folder;
  const std::filesystem::path target = folder / "out";
  {
    ExportFolder first(target);
    first.add(ExportFolder::kManifest, "first");
    first.commit();
  }
  {
    ExportFolder second(target);
    second.add(ExportFolder::kManifest, "second");  // and never committed
  }
  EXPECT_EQ(read_file(target / ExportFolder::kManifest), "first");
  EXPECT_EQ(folder.entries(), 1u);
}

TEST(ExportFolder, FolderOfSomethingElse_IsNotReplaced) {
  const TemporaryFolder folder;
  write_file(folder / "letter", "dear");
  EXPECT_THROW(ExportFolder{folder / "."}, Error);
}

}  // namespace
}  // namespace redmap
