// Whole bakes: planted reflectances come back with their weights, and the library's shaders reduce as they should.
#include "bake/bake.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "base/parallel.h"
#include "planted.h"

namespace redmap {
namespace {

constexpr Vec3 kRed{1, 0, 0}, kGreen{0, 1, 0}, kBlue{0, 0, 1};

ReductionMap bake_planted(int size, const PlantedWeights& weights, BakeReport* report = nullptr, float covered_u = 1) {
  BakeOptions options;
  options.size = size;
  return bake(SquareSurface(covered_u), PlantedShader(weights), options, report);
}

/// Which basis reflectance of the map is the planted one at `position`: the one met on that side of u.
int basis_left_of(const ReductionMap& map, float u) {
  for (std::size_t b = 0; b < map.basis.size(); ++b)
    if (map.basis[b].position.x < u) return static_cast<int>(b);
  return -1;
}

ReductionMap bake_library(const std::string& shader, int size, BasisSelection selection = BasisSelection::kGreedy) {
  BakeOptions options;
  options.size = size;
  options.selection = selection;
  return bake(*make_sphere(1), *make_library_shader(shader), options);
}

TEST(Bake, EdgeWithinATexel_IsAveragedOverItsParts) {
  const int size = 64;
  const float edge = (20 + 0.25f) / size;
  const ReductionMap map = bake_planted(size, [&](Vec3 p) { return p.x < edge ? kRed : kGreen; });
  ASSERT_EQ(map.basis.size(), 2u);
  EXPECT_LT(map.residual, 1e-4f);
  EXPECT_EQ(map.verdict, MapVerdict::kReduces);
  const int red = basis_left_of(map, edge), green = 1 - red;
  for (int y : {0, 31, 63}) {
    EXPECT_NEAR(map.weights.value(0, 19, y, red), 1, 0.003);
    EXPECT_NEAR(map.weights.value(0, 19, y, green), 0, 0.003);
    EXPECT_NEAR(map.weights.value(0, 20, y, red), 0.25, 0.003);
    EXPECT_NEAR(map.weights.value(0, 20, y, green), 0.75, 0.003);
    EXPECT_NEAR(map.weights.value(0, 21, y, green), 1, 0.003);
  }
  const int top = map.weights.levels() - 1;
  EXPECT_NEAR(map.weights.value(top, 0, 0, red), edge, 0.003);
}

TEST(Bake, Gradient_KeepsItsWeights_OnABasisOfItsEnds) {
  const int size = 64;
  const ReductionMap map = bake_planted(size, [](Vec3 p) { return kRed * (1 - p.x) + kGreen * p.x; });
  ASSERT_EQ(map.basis.size(), 2u);
  // Basis reflectances are texels' own: their mixture gives back the planted weights.
  for (int x = 0; x < size; x += 7) {
    Vec3 sum;
    for (int b = 0; b < 2; ++b) {
      const float u = map.basis[b].position.x;
      sum += (kRed * (1 - u) + kGreen * u) * map.weights.value(0, x, 30, b);
    }
    EXPECT_NEAR(sum.x, 1 - (static_cast<float>(x) + 0.5f) / size, 0.02);
    EXPECT_NEAR(sum.y, (static_cast<float>(x) + 0.5f) / size, 0.02);
  }
}

TEST(Bake, BorderOfTheSurface_IsCoveredInPart_AndNotMixedWithNothing) {
  const ReductionMap map = bake_planted(
      64, [](Vec3) { return kRed; }, nullptr, (40 + 0.75f) / 64);
  EXPECT_FLOAT_EQ(map.weights.coverage(0, 39, 5), 1);
  EXPECT_NEAR(map.weights.coverage(0, 40, 5), 0.75, 0.003);
  EXPECT_EQ(map.weights.coverage(0, 41, 5), 0);
  EXPECT_FLOAT_EQ(map.weights.value(0, 40, 5, 0), map.weights.value(0, 10, 5, 0));
}

TEST(Bake, WhatHidesBetweenTexelCentres_BecomesABasisReflectance) {
  // A blue dot of a sixteenth of a texel, off centre, in a texel beside the edge.
  const int size = 64;
  const PlantedWeights weights = [&](Vec3 p) {
    const float x = p.x * size, y = p.y * size;
    if (x >= 20.5f && x < 20.74f && y >= 30.76f && y < 31) return kBlue;
    return x < 20 ? kRed : kGreen;
  };
  BakeReport report;
  const ReductionMap map = bake_planted(size, weights, &report);
  ASSERT_EQ(map.basis.size(), 3u);
  EXPECT_EQ(report.outlier_basis, 1);
  EXPECT_LT(map.residual, 1e-4f);
  EXPECT_NEAR(map.weights.value(0, 20, 30, 2), 1.0 / 16, 0.003);
  EXPECT_NEAR(map.weights.value(0, 20, 29, 2), 0, 0.003);
}

TEST(Bake, MapIsTheSame_ForAnyNumberOfThreads) {
  for (const char* shader : {"marble", "granite"}) {
    std::vector<std::uint8_t> first;
    for (std::size_t threads : {1, 2, 7}) {
      const ThreadLimit limit(threads);
      const ReductionMap map = bake_library(shader, 96);
      std::vector<std::uint8_t> bytes;
      for (int level = 0; level < map.weights.levels(); ++level)
        for (int y = 0; y < map.weights.extent(level).height; ++y) {
          const auto row = map.weights.row(level, y);
          bytes.insert(bytes.end(), row.begin(), row.end());
        }
      if (first.empty()) first = bytes;
      EXPECT_TRUE(bytes == first) << shader << " with " << threads << " threads";
    }
  }
}

TEST(Bake, LibraryShaders_HaveTheBasisTheyWereMadeOf) {
  const std::pair<const char*, std::size_t> expected[] = {{"noise", 2},         {"scales", 3},      {"stone", 3},
                                                          {"checker", 2},       {"transparent", 2}, {"white", 1},
                                                          {"chrome_rubber", 2}, {"wet_dry", 2}};
  for (const auto& [shader, basis] : expected) {
    EXPECT_EQ(bake_library(shader, 128).basis.size(), basis) << shader;
    EXPECT_EQ(bake_library(shader, 128, BasisSelection::kPaper).basis.size(), basis) << shader << ", paper's selection";
  }
  const std::size_t marble = bake_library("marble", 128).basis.size();
  EXPECT_GE(marble, 4u);
  EXPECT_LE(marble, 6u);
}

TEST(Bake, WhatDoesNotReduce_SaysSo) {
  const ReductionMap granite = bake_library("granite", 64);
  EXPECT_EQ(granite.verdict, MapVerdict::kDoesNotReduce);
  EXPECT_GT(granite.residual, granite.tolerance);
  EXPECT_NE(granite.verdict_reason.find("residual"), std::string::npos);
  const ReductionMap pulsing = bake_library("pulsing", 64);
  EXPECT_EQ(pulsing.verdict, MapVerdict::kDoesNotReduce);
  EXPECT_NE(pulsing.verdict_reason.find("time"), std::string::npos);
}

TEST(Bake, PerturbedNormals_AreInTheMap_BesideOneMetal) {
  const ReductionMap hammered = bake_library("hammered_metal", 64);
  EXPECT_EQ(hammered.basis.size(), 1u) << "sampled in the shading frame it is one metal";
  EXPECT_EQ(hammered.verdict, MapVerdict::kReduces);
  ASSERT_EQ(hammered.normals.levels(), hammered.weights.levels());
  ASSERT_EQ(hammered.lobes.size(), 1u);
  EXPECT_LT(hammered.lobes[0].error, 0.05f);
  EXPECT_TRUE(bake_library("noise", 64).normals.empty()) << "its shading normals are the interpolated ones";
}

TEST(Bake, OneMaterial_IsRecommendedWhereItIsEnough_AndOnlyThere) {
  EXPECT_EQ(bake_library("white", 64).verdict, MapVerdict::kOneMaterial);
  for (const char* shader : {"chrome_rubber", "two_tinted_satin", "wet_dry"})
    EXPECT_EQ(bake_library(shader, 128).verdict, MapVerdict::kReduces) << shader;
}

TEST(Bake, StopsWhenAskedTo) {
  BakeOptions options;
  options.size = 64;
  for (float stop_at : {0.0f, 0.2f, 0.6f}) {
    float last = -1;
    options.progress = [&](float fraction, std::string_view) {
      EXPECT_GE(fraction, last);
      EXPECT_LE(fraction, 1);
      last = fraction;
      return fraction < stop_at;
    };
    EXPECT_THROW(bake(*make_sphere(1), *make_library_shader("noise"), options), BakeInterrupted) << stop_at;
  }
}

TEST(Bake, RefusesOptionsOutOfRange_AndBareSurfaces) {
  const auto refuses = [](const BakeOptions& options, float covered_u = 1) {
    EXPECT_THROW(bake(SquareSurface(covered_u), PlantedShader([](Vec3) { return kRed; }), options), Error);
  };
  BakeOptions options;
  options.size = 0;
  refuses(options);
  options = {}, options.tolerance = -1;
  refuses(options);
  options = {}, options.max_basis = 17;
  refuses(options);
  options = {}, options.sub_samples = 0;
  refuses(options);
  options = {}, options.size = 8;
  refuses(options, 0);
}

}  // namespace
}  // namespace redmap
