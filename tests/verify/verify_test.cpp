#include "verify/verify.h"

#include <gtest/gtest.h>

#include <cstring>

#include "bake/bake.h"
#include "base/error.h"
#include "base/parallel.h"

namespace redmap {
namespace {

Object ball(const std::string& shader, const ParameterOverrides& parameters = {}) {
  Object object;
  object.name = "ball";
  object.surface = make_sphere(1);
  object.shader = make_library_shader(shader, parameters);
  return object;
}

std::shared_ptr<ReductionMap> map_of(const Object& object, int size, float tolerance = 0.025f, int max_basis = 8) {
  BakeOptions options;
  options.size = size, options.tolerance = tolerance, options.max_basis = max_basis;
  return std::make_shared<ReductionMap>(bake(*object.surface, *object.shader, options));
}

VerifyOptions few_pixels(std::vector<float> minifications) {
  VerifyOptions options;
  options.minifications = std::move(minifications);
  options.pixels = 40, options.spp = 256;
  return options;
}

double part_of(const VerifyReport& report, Stage stage) { return report.shares[static_cast<int>(stage)].part; }

TEST(Verify, WhiteLambert_IsRight_AtEveryDistance) {
  const Object object = ball("white");
  const VerifyReport report = verify(object, map_of(object, 64), few_pixels({0.5f, 1, 2, 4}));
  // White is 1: what is left is a regular grid of 2 x 2 normals against jittered ones.
  EXPECT_LT(report.all.rms, 0.004);
  EXPECT_EQ(report.by_minification.size(), 4u);
}

TEST(Verify, CloseUp_IsTheShaderItself_AndHasNoStages) {
  const Object object = ball("noise");
  const VerifyReport report = verify(object, map_of(object, 64), few_pixels({0.05f}));
  for (const MeasuredPixel& pixel : report.pixels) {
    EXPECT_FALSE(pixel.by_map);
    EXPECT_LT(pixel.error, 0.1);
  }
}

TEST(Verify, BasisOfOneWhereTwoAreNeeded_IsAnErrorOfTheFit) {
  const Object object = ball("checker");
  const VerifyReport report = verify(object, map_of(object, 256, 100, 1), few_pixels({2, 4, 8}));
  EXPECT_EQ(report.certificate.weakest, "fit");
  EXPECT_GT(part_of(report, Stage::kFit), 0.8);
  EXPECT_GT(report.all.rms, 0.05);
}

TEST(Verify, TexelsWiderThanTheNoise_AreAnErrorOfTheTexels) {
  const Object object = ball("noise", {{"scale", {40}}});
  const VerifyReport report = verify(object, map_of(object, 32), few_pixels({2}));
  EXPECT_EQ(report.certificate.weakest, "texels");
}

TEST(Verify, MirrorsOnAFarSphere_AreAnErrorOfTheNormals) {
  const Object object = ball("scales");
  const VerifyReport report = verify(object, map_of(object, 512), few_pixels({32}));
  EXPECT_EQ(report.certificate.weakest, "normals");
}

TEST(Verify, StagesAddUpToTheError_AndTheirPartsToOne) {
  const Object object = ball("marble");
  const VerifyReport report = verify(object, map_of(object, 128), few_pixels({4, 8}));
  for (const MeasuredPixel& pixel : report.pixels) {
    ASSERT_TRUE(pixel.by_map);
    Rgb sum;
    for (const Rgb& stage : pixel.stages) sum += stage;
    // Half of the truth's samples against all of them: apart by the residual.
    EXPECT_LT(rms(sum - (pixel.map - pixel.truth)), pixel.residual + 1e-5);
  }
  double parts = 0;
  for (const StageShare& share : report.shares) parts += share.part;
  EXPECT_NEAR(parts, 1, 1e-6);
}

/// The weights of all texels with u and v in [.4, .6), down to a quarter.
void damage(ReductionMap& map) {
  for (int level = 0; level < map.weights.levels(); ++level) {
    const Extent extent = map.weights.extent(level);
    for (int y = extent.height * 2 / 5; y < extent.height * 3 / 5; ++y) {
      const auto row = map.weights.row(level, y);
      for (int x = extent.width * 2 / 5; x < extent.width * 3 / 5; ++x)
        for (int c = 1; c <= map.weights.channels(); ++c) row[x * map.weights.texel_stride() + c] /= 4;
    }
  }
  map.weights.pad_rows();
}

TEST(Verify, DamagedTexels_AreFoundWhereTheyAre) {
  const Object object = ball("white");
  const auto map = map_of(object, 128);
  damage(*map);
  VerifyOptions options = few_pixels({2});
  options.pixels = 400;
  const VerifyReport report = verify(object, map, options);
  EXPECT_EQ(report.certificate.weakest, "texels");
  EXPECT_NEAR(report.certificate.worst.uv.x, 0.5f, 0.12f);
  EXPECT_NEAR(report.certificate.worst.uv.y, 0.5f, 0.12f);
  EXPECT_GT(report.certificate.worst.error, 0.2f);
}

TEST(Verify, ReportIsTheSame_ForAnyNumberOfThreads) {
  const Object object = ball("scales");
  const auto map = map_of(object, 64);
  std::vector<VerifyReport> reports;
  for (const std::size_t threads : {1, 2, 7}) {
    const ThreadLimit limit(threads);
    reports.push_back(verify(object, map, few_pixels({1, 4})));
  }
  for (const VerifyReport& report : reports) {
    ASSERT_EQ(report.pixels.size(), reports[0].pixels.size());
    EXPECT_EQ(report.all.rms, reports[0].all.rms);
    for (std::size_t i = 0; i < report.pixels.size(); ++i)
      EXPECT_EQ(std::memcmp(&report.pixels[i].stages, &reports[0].pixels[i].stages, sizeof(StageErrors)), 0);
  }
}

TEST(Verify, MapsOfAllSizes_AnswerForTheSameDistances) {
  ReductionMap map;
  map.size = 16;
  EXPECT_EQ(verified_minifications(map), (std::vector<float>{0.5f}));
  map.size = 256;
  EXPECT_EQ(verified_minifications(map), (std::vector<float>{0.5f, 1, 2, 4, 8}));
}

TEST(Verify, AnotherSeed_GivesOtherPixels) {
  const Object object = ball("noise");
  const auto map = map_of(object, 64);
  VerifyOptions options = few_pixels({2});
  const VerifyReport first = verify(object, map, options);
  options.seed = 1;
  EXPECT_NE(first.pixels.front().pixel.uv, verify(object, map, options).pixels.front().pixel.uv);
}

TEST(Verify, OptionsOutOfRange_AreRefused) {
  const Object object = ball("noise");
  const auto map = map_of(object, 16);
  VerifyOptions options = few_pixels({-1});
  EXPECT_THROW(verify(object, map, options), Error);
  options = few_pixels({2}), options.pixels = 0;
  EXPECT_THROW(verify(object, map, options), Error);
  options = few_pixels({2}), options.coverage = 1;
  EXPECT_THROW(verify(object, map, options), Error);
  // Pixels far wider than the sphere see no interior.
  EXPECT_THROW(verify(object, map, few_pixels({1000})), Error);
}

TEST(Verify, TooFewPixelsForTheCoverage_HaveNoBound) {
  const Object object = ball("noise");
  VerifyOptions options = few_pixels({2});
  options.pixels = 10;
  const VerifyReport report = verify(object, map_of(object, 64), options);
  EXPECT_FALSE(report.by_minification.front().bound);
  EXPECT_TRUE(report.certificate.rows.empty());
}

TEST(Verify, AveragedMaterial_IsAsGoodAsAMapOfNoise_ButNotOfChromeAndRubber) {
  const auto bounds = [](const std::string& shader) {
    const Object object = ball(shader);
    const auto map = map_of(object, 128);
    const VerifyOptions options = few_pixels({4, 8});
    return std::pair{*largest_error_bound(verify(object, map, options).by_minification),
                     *largest_error_bound(verify_averaged_material(object, *map, options))};
  };
  const auto [noise, averaged_noise] = bounds("noise");
  EXPECT_LT(averaged_noise, 1.2 * noise);
  const auto [chrome, averaged_chrome] = bounds("chrome_rubber");
  EXPECT_GT(averaged_chrome, 2 * chrome);
}

}  // namespace
}  // namespace redmap
