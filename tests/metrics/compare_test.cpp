#include "metrics/compare.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "base/error.h"
#include "base/parallel.h"
#include "base/random.h"

namespace redmap {
namespace {

Image flat(float value) { return {8, 4, 3, value}; }

Image noise(std::uint64_t seed, int width = 32, int height = 16) {
  Image image(width, height, 3);
  Random random(seed);
  for (float& value : image.data) value = 2 * random.next_float();
  return image;
}

TEST(Compare, ConstantOffset_IsTheErrorTheBiasAndTheRmse) {
  const Comparison result = compare_images(flat(0.75f), flat(0.5f));
  EXPECT_EQ(result.pixels, 32u);
  EXPECT_DOUBLE_EQ(result.rmse, 0.25);
  EXPECT_DOUBLE_EQ(result.rmse_clamped, 0.25);
  EXPECT_DOUBLE_EQ(result.bias, 0.25);
  EXPECT_DOUBLE_EQ(result.mean_error, 0.25);
  EXPECT_DOUBLE_EQ(result.max_error, 0.25);
  EXPECT_NEAR(result.psnr, 12.0412, 1e-4);  // 20 log10 4
  EXPECT_DOUBLE_EQ(result.relative_mse, 0.0625 / (0.25 + 0.01));
  EXPECT_DOUBLE_EQ(compare_images(flat(0.25f), flat(0.5f)).bias, -0.25);
}

TEST(Compare, SamePicture_HasNoErrorAndInfinitePsnr) {
  const Comparison result = compare_images(noise(1), noise(1));
  EXPECT_EQ(result.rmse, 0);
  EXPECT_EQ(result.flip, 0);
  EXPECT_EQ(result.psnr, std::numeric_limits<double>::infinity());
}

TEST(Compare, LightAboveOne_CountsOnlyUnclamped) {
  const Comparison result = compare_images(flat(3), flat(1));
  EXPECT_DOUBLE_EQ(result.rmse, 2);
  EXPECT_EQ(result.rmse_clamped, 0);
  EXPECT_EQ(result.flip, 0);
}

TEST(Compare, OneWrongChannelOfOnePixel_IsFoundAndWeighed) {
  Image image = flat(0.5f);
  image.at(6, 3, 1) += 0.5f;
  CompareOptions options;
  options.worst_pixels = 2;
  const Comparison result = compare_images(image, flat(0.5f), options);
  EXPECT_DOUBLE_EQ(result.rmse, std::sqrt(0.25 / (3 * 32)));
  EXPECT_DOUBLE_EQ(result.max_error, 0.5);
  ASSERT_EQ(result.worst.size(), 2u);
  EXPECT_EQ(result.worst[0].x, 6);
  EXPECT_EQ(result.worst[0].y, 3);
  EXPECT_NEAR(result.worst[0].error, std::sqrt(0.25 / 3), 1e-12);
  EXPECT_EQ(result.worst[1].error, 0);
}

TEST(Compare, WorstPixels_AreThoseOfAFullSort) {
  const Image image = noise(1), reference = noise(2);
  std::vector<double> errors;
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) {
      double sum = 0;
      for (int c = 0; c < 3; ++c) sum += std::pow(image.at(x, y, c) - reference.at(x, y, c), 2.0);
      errors.push_back(std::sqrt(sum / 3));
    }
  std::sort(errors.rbegin(), errors.rend());
  CompareOptions options;
  options.worst_pixels = 20;
  const Comparison result = compare_images(image, reference, options);
  ASSERT_EQ(result.worst.size(), 20u);
  for (std::size_t i = 0; i < 20; ++i) EXPECT_NEAR(result.worst[i].error, errors[i], 1e-6);
}

TEST(Compare, Mask_LimitsEveryFigureToItsPixels) {
  Image image = flat(0.5f), mask(8, 4, 1);
  for (int y = 0; y < 4; ++y)
    for (int x = 0; x < 8; ++x) {
      mask.at(x, y, 0) = x < 4 ? 1.0f : 0.5f;  // only above .5 counts
      if (x >= 4) image.set_rgb(x, y, {9, 9, 9});
    }
  image.at(1, 1, 0) += 0.5f;
  CompareOptions options;
  options.mask = &mask;
  const Comparison result = compare_images(image, flat(0.5f), options);
  EXPECT_EQ(result.pixels, 16u);
  EXPECT_DOUBLE_EQ(result.rmse, std::sqrt(0.25 / (3 * 16)));
  EXPECT_DOUBLE_EQ(result.max_error, 0.5);
  EXPECT_EQ(result.worst.front().x, 1);
}

TEST(Compare, GreyPicture_CountsAsEqualChannels) {
  const Comparison result = compare_images(Image(8, 4, 1, 0.75f), flat(0.5f));
  EXPECT_DOUBLE_EQ(result.rmse, 0.25);
}

TEST(Compare, Alpha_DoesNotCount) {
  Image image(8, 4, 4, 0.5f);
  for (std::size_t i = 3; i < image.data.size(); i += 4) image.data[i] = 1;
  EXPECT_EQ(compare_images(image, flat(0.5f)).rmse, 0);
}

TEST(Compare, AnyNumberOfThreads_GivesTheSameBits) {
  const Image image = noise(1, 211, 97), reference = noise(2, 211, 97);
  const auto figures = [&](std::size_t threads) {
    const ThreadLimit limit(threads);
    const Comparison c = compare_images(image, reference);
    return std::vector<double>{c.rmse, c.rmse_clamped, c.psnr, c.relative_mse, c.bias, c.mean_error, c.flip};
  };
  const std::vector<double> one = figures(1);
  EXPECT_EQ(figures(2), one);
  EXPECT_EQ(figures(7), one);
}

TEST(Compare, WhatCannotBeCompared_IsAnError) {
  Image nan = flat(0), empty_mask(8, 4, 1);
  nan.at(2, 1, 1) = std::numeric_limits<float>::quiet_NaN();
  EXPECT_THROW(compare_images(Image(4, 8, 3), flat(0)), Error);
  EXPECT_THROW(compare_images(nan, flat(0)), Error);
  EXPECT_THROW(compare_images(flat(0), nan), Error);
  const Image small_mask(4, 4, 1, 1);
  CompareOptions options;
  options.mask = &small_mask;
  EXPECT_THROW(compare_images(flat(0), flat(0), options), Error);
  options.mask = &empty_mask;
  EXPECT_THROW(compare_images(flat(0), flat(0), options), Error);
}

TEST(Compare, DifferencePicture_ShowsTheAbsoluteErrorTimesTheGain) {
  Image mask(8, 4, 1, 1);
  mask.at(0, 0, 0) = 0;
  const Image picture = difference_picture(flat(0.25f), flat(0.5f), &mask, 2);
  EXPECT_EQ(picture.rgb(5, 2), (Rgb{0.5f, 0.5f, 0.5f}));
  EXPECT_EQ(picture.rgb(0, 0), (Rgb{}));
}

}  // namespace
}  // namespace redmap
