#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <vector>

#include "base/error.h"
#include "base/temporary_folder.h"
#include "metrics/compare.h"

namespace redmap {
namespace {

Image flat(float value) { return {4, 2, 3, value}; }

TEST(Flicker, ErrorThatStays_IsNoFlicker) {
  FlickerMeter meter;
  for (int frame = 0; frame < 3; ++frame) meter.add(flat(0.75f), flat(0.5f));
  EXPECT_EQ(meter.flicker(), 0);
  EXPECT_EQ(meter.pixels(), 16u);
}

TEST(Flicker, MotionThatTheReferenceShares_IsNoFlicker) {
  FlickerMeter meter;
  for (const float light : {0.25f, 0.75f, 0.5f}) meter.add(flat(light), flat(light));
  EXPECT_EQ(meter.flicker(), 0);
}

TEST(Flicker, ErrorThatAlternates_FlickersByItsSwing) {
  FlickerMeter meter;
  for (const float light : {0.5f, 0.75f, 0.5f, 0.75f}) meter.add(flat(light), flat(0.5f));
  EXPECT_DOUBLE_EQ(meter.flicker(), 0.25);
}

TEST(Flicker, OnePixelOfEight_IsWeighedByTheRootOfItsShare) {
  FlickerMeter meter;
  Image blinking = flat(0.5f);
  blinking.set_rgb(3, 1, {1, 1, 1});
  meter.add(flat(0.5f), flat(0.5f));
  EXPECT_EQ(meter.flicker(), 0);
  meter.add(blinking, flat(0.5f));
  EXPECT_DOUBLE_EQ(meter.flicker(), std::sqrt(0.25 / 8));
}

TEST(Flicker, PixelsCountOnlyWhereBothFramesAreInside) {
  // One pixel inside moves right each frame: no pixel is inside twice, except the one that both masks share.
  FlickerMeter meter;
  for (int frame = 0; frame < 3; ++frame) {
    Image mask(4, 2, 1);
    mask.at(frame, 0, 0) = mask.at(0, 1, 0) = 1;
    Image image = flat(static_cast<float>(frame));
    image.set_rgb(0, 1, {0.5f, 0.5f, 0.5f});
    meter.add(image, flat(0), &mask);
  }
  EXPECT_EQ(meter.pixels(), 2u);
  EXPECT_EQ(meter.flicker(), 0);
}

TEST(Flicker, FramesOfDifferentSize_AreAnError) {
  FlickerMeter meter;
  meter.add(flat(0), flat(0));
  EXPECT_THROW(meter.add(Image(2, 2, 3), Image(2, 2, 3)), Error);
}

class Sequence : public testing::Test {
 protected:
  using Paths = std::vector<std::filesystem::path>;
  Paths write(const std::string& name, const std::vector<Image>& frames) {
    Paths paths;
    for (const Image& frame : frames) {
      paths.push_back(folder_ / (name + std::to_string(paths.size()) + ".exr"));
      write_image(frame, paths.back());
    }
    return paths;
  }
  TemporaryFolder folder_;
};

TEST_F(Sequence, PoolsFramesAsOnePicture_AndNamesTheWorst) {
  const Paths images = write("image", {flat(0.5f), flat(0.75f), flat(0.5f)});
  const Paths references = write("reference", {flat(0.5f), flat(0.5f), flat(0.5f)});
  const SequenceComparison result = compare_sequences(images, references, {});
  EXPECT_EQ(result.all.pixels, 24u);
  EXPECT_DOUBLE_EQ(result.all.rmse, std::sqrt(0.0625 / 3));
  EXPECT_DOUBLE_EQ(result.all.bias, 0.25 / 3);
  EXPECT_DOUBLE_EQ(result.all.psnr, -10 * std::log10(0.0625 / 3));
  EXPECT_DOUBLE_EQ(result.all.max_error, 0.25);
  EXPECT_EQ(result.worst_frame, 1u);
  EXPECT_EQ(result.all.worst.front().error, 0.25);
  EXPECT_DOUBLE_EQ(result.flicker, 0.25);
  EXPECT_EQ(result.flicker_pixels, 16u);
}

TEST_F(Sequence, Masks_ApplyFrameByFrame) {
  Image left(4, 2, 1);
  left.at(0, 0, 0) = 1;
  Image half_wrong = flat(0.5f);
  half_wrong.set_rgb(3, 0, {9, 9, 9});
  const Paths images = write("image", {half_wrong, half_wrong}), masks = write("mask", {left, left});
  const Paths references = write("reference", {flat(0.5f), flat(0.5f)});
  const SequenceComparison result = compare_sequences(images, references, masks);
  EXPECT_EQ(result.all.pixels, 2u);
  EXPECT_EQ(result.all.rmse, 0);
}

TEST_F(Sequence, UnequalNumbersOfFrames_AreAnError) {
  const Paths two = write("image", {flat(0), flat(0)}), one = write("reference", {flat(0)});
  EXPECT_THROW(compare_sequences(two, one, {}), Error);
  EXPECT_THROW(compare_sequences(two, two, one), Error);
  EXPECT_THROW(compare_sequences({}, {}, {}), Error);
}

}  // namespace
}  // namespace redmap
