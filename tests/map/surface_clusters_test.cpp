// Clusters of a surface: the mean of what lies under a footprint, and of nothing else.
#include "map/surface_clusters.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "base/error.h"
#include "base/random.h"

namespace redmap {
namespace {

constexpr std::size_t kSide = 128, kLeaves = 1024;

struct Cells {
  std::vector<ClusterPlace> places;
  std::vector<float> weights;
};

/// A unit square in z = `height`, facing along `normal`, every cell with the weight that `weight` gives it.
template <typename Weight>
void add_square(float height, Vec3 normal, const Weight& weight, Cells& cells) {
  for (std::size_t i = 0; i < kSide * kSide; ++i) {
    const Vec3 p{(static_cast<float>(i % kSide) + 0.5f) / kSide, (static_cast<float>(i / kSide) + 0.5f) / kSide,
                 height};
    cells.places.push_back({p, normal, 0, 0});
    cells.weights.push_back(weight(p));
  }
}

SurfaceFootprint square_footprint(Vec3 centre, float width, Vec3 normal = {0, 0, 1}) {
  return {centre, normal, {width, 0, 0}, {0, width, 0}};
}

float look_up(const SurfaceClusters& clusters, const SurfaceFootprint& footprint) {
  std::array<float, kMaxChannels> weights;
  EXPECT_TRUE(clusters.lookup(footprint, weights));
  return weights[0];
}

TEST(SurfaceClusters, AConstantStaysConstant_AtEveryWidth) {
  Cells cells;
  add_square(
      0, {0, 0, 1}, [](Vec3) { return 0.37f; }, cells);
  const SurfaceClusters clusters = SurfaceClusters::build(cells.places, cells.weights, 1, kLeaves);
  for (const float width : {0.05f, 0.1f, 1.0f, 100.0f})
    EXPECT_NEAR(look_up(clusters, square_footprint({0.3f, 0.6f, 0}, width)), 0.37f, 1e-6f) << width;
}

TEST(SurfaceClusters, AWideFootprintGivesTheMeanOfAll) {
  Cells cells;
  Random random(2);
  double sum = 0;
  add_square(
      0, {0, 0, 1}, [&](Vec3) { return random.next_float(); }, cells);
  for (const float w : cells.weights) sum += w;
  const SurfaceClusters clusters = SurfaceClusters::build(cells.places, cells.weights, 1, kLeaves);
  EXPECT_NEAR(look_up(clusters, square_footprint({0.5f, 0.5f, 0}, 1e3f)), sum / (kSide * kSide), 1e-5);
}

TEST(SurfaceClusters, ALinearSignalIsReproduced_SoThatNothingIsShifted) {
  Cells cells;
  add_square(
      0, {0, 0, 1}, [](Vec3 p) { return p.x; }, cells);
  const SurfaceClusters clusters = SurfaceClusters::build(cells.places, cells.weights, 1, kLeaves);
  for (const float x : {0.3f, 0.41f, 0.55f, 0.7f})
    EXPECT_NEAR(look_up(clusters, square_footprint({x, 0.5f, 0}, 0.25f)), x, 0.01f);
}

TEST(SurfaceClusters, TheBackOfAThinSheetNeverShowsThrough) {
  Cells cells;
  add_square(
      0.001f, {0, 0, 1}, [](Vec3) { return 1.0f; }, cells);
  add_square(
      -0.001f, {0, 0, -1}, [](Vec3) { return 0.0f; }, cells);
  const SurfaceClusters clusters = SurfaceClusters::build(cells.places, cells.weights, 1, kLeaves);
  for (const float width : {0.05f, 0.5f, 5.0f}) {
    EXPECT_EQ(look_up(clusters, square_footprint({0.5f, 0.5f, 0.001f}, width)), 1.0f);
    EXPECT_EQ(look_up(clusters, square_footprint({0.5f, 0.5f, -0.001f}, width, {0, 0, -1})), 0.0f);
  }
}

TEST(SurfaceClusters, ALongFootprintIsNarrowAcross) {
  Cells cells;
  add_square(
      0, {0, 0, 1}, [](Vec3 p) { return std::abs(p.x - 0.5f) < 0.1f ? 1.0f : 0.0f; }, cells);
  const SurfaceClusters clusters = SurfaceClusters::build(cells.places, cells.weights, 1, kLeaves);
  EXPECT_GT(look_up(clusters, {{0.5f, 0.5f, 0}, {0, 0, 1}, {0.1f, 0, 0}, {0, 0.8f, 0}}), 0.95f);
  EXPECT_LT(look_up(clusters, {{0.5f, 0.5f, 0}, {0, 0, 1}, {0.8f, 0, 0}, {0, 0.1f, 0}}), 0.45f);
}

TEST(SurfaceClusters, WhereNothingIs_NothingIsFound) {
  Cells cells;
  add_square(
      0, {0, 0, 1}, [](Vec3) { return 1.0f; }, cells);
  const SurfaceClusters clusters = SurfaceClusters::build(cells.places, cells.weights, 1, kLeaves);
  std::array<float, kMaxChannels> weights;
  EXPECT_FALSE(clusters.lookup(square_footprint({50, 50, 50}, 0.1f), weights));
  EXPECT_FALSE(clusters.lookup(square_footprint({0.5f, 0.5f, 0}, 0), weights));
  EXPECT_FALSE(clusters.lookup(square_footprint({0.5f, 0.5f, 0}, std::numeric_limits<float>::quiet_NaN()), weights));
  EXPECT_FALSE(SurfaceClusters().lookup(square_footprint({0, 0, 0}, 1), weights));
}

TEST(SurfaceClusters, LeavesThatAreNoTreeOrNotFinite_AreRefused) {
  EXPECT_THROW(SurfaceClusters(std::vector<ClusterPlace>(3), std::vector<float>(3), 1), Error);
  EXPECT_THROW(SurfaceClusters(std::vector<ClusterPlace>(4), std::vector<float>(3), 1), Error);
  std::vector<float> weights(4);
  weights[2] = std::numeric_limits<float>::infinity();
  EXPECT_THROW(SurfaceClusters(std::vector<ClusterPlace>(4), weights, 1), Error);
}

TEST(SurfaceClusters, TakeOverFromEightToSixteenTexels) {
  const auto part = [](float texels) {
    return cluster_part({{0.5f, 0.5f}, {texels / 1024, 0}, {0, texels / 1024}}, {1024, 1024});
  };
  EXPECT_EQ(part(1), 0.0f);
  EXPECT_EQ(part(7.9f), 0.0f);
  EXPECT_GT(part(10), 0.1f);
  EXPECT_LT(part(10), 0.9f);
  EXPECT_EQ(part(16.1f), 1.0f);
}

}  // namespace
}  // namespace redmap
