#include "metrics/flip.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "base/parallel.h"
#include "base/random.h"

namespace redmap {
namespace {

constexpr int kWidth = 96, kHeight = 64;

/// Waves of colour, with hard-edged squares in the lower half.
Image picture() {
  Image image(kWidth, kHeight, 3);
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x) {
      const double waves[3] = {0.5 + 0.4 * std::sin(0.31 * x + 0.05 * y), 0.5 + 0.35 * std::sin(0.11 * x - 0.23 * y),
                               0.5 + 0.3 * std::cos(0.17 * x + 0.07 * y)};
      const bool dark = y >= kHeight / 2 && (x / 6 + y / 6) % 2 == 0;
      for (int c = 0; c < 3; ++c) image.at(x, y, c) = static_cast<float>(dark ? 0.1 * waves[c] : waves[c]);
    }
  return image;
}

Image noisy(Image image) {
  for (std::size_t i = 0; i < image.data.size(); ++i)
    image.data[i] = std::clamp(image.data[i] + 0.2f * (unit_float(hash64(i)) - 0.5f), 0.0f, 1.0f);
  return image;
}

/// Mean of 3 x 3 pixels; outside, the border goes on.
Image blurred(const Image& image) {
  Image result = image;
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x)
      for (int c = 0; c < 3; ++c) {
        float sum = 0;
        for (int j = y - 1; j <= y + 1; ++j)
          for (int i = x - 1; i <= x + 1; ++i)
            sum += image.at(std::clamp(i, 0, image.width - 1), std::clamp(j, 0, image.height - 1), c);
        result.at(x, y, c) = sum / 9;
      }
  return result;
}

Image tinted(Image image) {
  for (std::size_t i = 0; i < image.data.size(); i += 3) {
    image.data[i] *= 0.8f;
    image.data[i + 2] = std::min(1.1f * image.data[i + 2], 1.0f);
  }
  return image;
}

double mean(const Image& image) {
  double sum = 0;
  for (const float value : image.data) sum += value;
  return sum / static_cast<double>(image.data.size());
}

/// What the authors' implementation says; flip_reference.py prints these figures and names its version.
struct KnownAnswer {
  const char* name;
  Image (*make)(const Image&);
  double mean;
  float inside, at_corner;  ///< at pixels (10, 20) and (95, 63)
};

class FlipKnownAnswer : public testing::TestWithParam<KnownAnswer> {};
INSTANTIATE_TEST_SUITE_P(Pairs, FlipKnownAnswer,
                         testing::Values(KnownAnswer{"Noise", [](const Image& image) { return noisy(image); }, 0.115757,
                                                     0.080689f, 0.211979f},
                                         KnownAnswer{"Blur", [](const Image& image) { return blurred(image); },
                                                     0.124883, 0.069603f, 0.111855f},
                                         KnownAnswer{"Tint", [](const Image& image) { return tinted(image); }, 0.218781,
                                                     0.183251f, 0.313838f}),
                         [](const auto& test) { return test.param.name; });

TEST_P(FlipKnownAnswer, AgreesWithTheAuthorsImplementation) {
  const KnownAnswer& known = GetParam();
  const Image difference = flip_difference(known.make(picture()), picture());
  EXPECT_NEAR(mean(difference), known.mean, 1e-4);
  EXPECT_NEAR(difference.at(10, 20, 0), known.inside, 1e-3f);
  EXPECT_NEAR(difference.at(95, 63, 0), known.at_corner, 1e-3f);
}

TEST(Flip, SamePicture_HasNoDifference) { EXPECT_EQ(mean(flip_difference(picture(), picture())), 0); }

TEST(Flip, GreenAgainstBlue_IsTheLargestColourDifference) {
  Image green(16, 16, 3), blue(16, 16, 3);
  for (int y = 0; y < 16; ++y)
    for (int x = 0; x < 16; ++x) green.set_rgb(x, y, {0, 1, 0}), blue.set_rgb(x, y, {0, 0, 1});
  // Flat pictures have no features, so the difference in colour is all: one, by section 4.1.3.
  EXPECT_NEAR(mean(flip_difference(green, blue)), 1, 1e-4);
}

TEST(Flip, ExchangingThePictures_ChangesNothing) {
  const Image image = noisy(picture());
  EXPECT_EQ(flip_difference(image, picture()).data, flip_difference(picture(), image).data);
}

TEST(Flip, AnyNumberOfThreads_GivesTheSameBits) {
  const Image image = noisy(picture());
  const std::vector<float> one = [&] {
    const ThreadLimit limit(1);
    return flip_difference(image, picture()).data;
  }();
  const ThreadLimit limit(7);
  EXPECT_EQ(flip_difference(image, picture()).data, one);
}

TEST(Flip, ValuesOutsideZeroToOne_CountAsClamped) {
  Image bright(8, 8, 3, 5), white(8, 8, 3, 1);
  EXPECT_EQ(mean(flip_difference(bright, white)), 0);
}

TEST(Flip, PictureSmallerThanTheFilters_IsFine) {
  EXPECT_GT(mean(flip_difference(Image(1, 1, 3, 0.2f), Image(1, 1, 3, 0.8f))), 0.1);
}

}  // namespace
}  // namespace redmap
