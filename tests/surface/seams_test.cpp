// Over a seam one comes out where the surface goes on, on a flat square cut in two.
#include "surface/seams.h"

#include <gtest/gtest.h>

#include "surface/charts.h"
#include "surface/shapes.h"

namespace redmap {
namespace {

/// The unit square in the plane z = 0 as two triangles beside its diagonal; uv of each as given.
TriangleMesh square(std::array<Vec2, 3> lower_right, std::array<Vec2, 3> upper_left) {
  TriangleMesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  mesh.uv = {lower_right[0], lower_right[1], lower_right[2], upper_left[0], upper_left[1], upper_left[2]};
  mesh.uv_triangles = {{0, 1, 2}, {3, 4, 5}};
  return mesh;
}

Seams seams_of(const TriangleMesh& mesh) { return Seams(mesh, find_charts(mesh)); }

/// The other side of the diagonal, seen from (x, y) of the square, .4 x .4 large in uv, at the origin.
const SeamEdge* cross_diagonal(const std::vector<SeamEdge>& edges, Vec2 from, Vec2 to) {
  return first_crossed(edges, from * 0.4f, (to - from) * 0.4f);
}

void expect_near(Vec2 a, Vec2 b) {
  EXPECT_NEAR(a.x, b.x, 1e-5f);
  EXPECT_NEAR(a.y, b.y, 1e-5f);
}

constexpr std::array<Vec2, 3> kLowerRight{Vec2{0, 0}, Vec2{0.4f, 0}, Vec2{0.4f, 0.4f}};

TEST(Seams, TheOtherChartMayBeTurnedScaledAndMirrored) {
  // (x, y) of the square goes to .2 (-y, x) + (.9, .5), and mirrored to .2 (y, x) + (.5, .5).
  const std::array<Vec2, 3> turned{Vec2{0.9f, 0.5f}, Vec2{0.7f, 0.7f}, Vec2{0.7f, 0.5f}};
  const std::array<Vec2, 3> mirrored{Vec2{0.5f, 0.5f}, Vec2{0.7f, 0.7f}, Vec2{0.7f, 0.5f}};
  for (const auto& [upper_left, expected, step_x] :
       {std::tuple{turned, Vec2{0.9f - 0.2f * 0.6f, 0.5f + 0.2f * 0.3f}, Vec2{0, 0.2f}},
        std::tuple{mirrored, Vec2{0.5f + 0.2f * 0.6f, 0.5f + 0.2f * 0.3f}, Vec2{0, 0.2f}}}) {
    const std::vector<SeamEdge> edges = seams_of(square(kLowerRight, upper_left)).near({0.2f, 0.1f}, 0, 0.2f);
    const Vec2 from{0.6f, 0.3f}, to{0.3f, 0.6f};
    const SeamEdge* edge = cross_diagonal(edges, from, to);
    ASSERT_NE(edge, nullptr);
    expect_near(edge->beyond(to * 0.4f), expected);
    expect_near(edge->direction_beyond({0.4f, 0}), step_x);
  }
}

TEST(Seams, NothingIsCrossedInsideTheChart_NorAtTheBorderOfTheSurface) {
  const TriangleMesh mesh = square(kLowerRight, {Vec2{0.6f, 0.6f}, Vec2{0.9f, 0.9f}, Vec2{0.6f, 0.9f}});
  const std::vector<SeamEdge> edges = seams_of(mesh).near({0.2f, 0.1f}, 0, 0.3f);
  EXPECT_EQ(edges.size(), 1u);
  EXPECT_EQ(cross_diagonal(edges, {0.6f, 0.3f}, {0.5f, 0.4f}), nullptr);
  EXPECT_EQ(cross_diagonal(edges, {0.6f, 0.3f}, {0.6f, -0.3f}), nullptr);
  EXPECT_NE(cross_diagonal(edges, {0.6f, 0.3f}, {0.4f, 0.5f}), nullptr);
}

TEST(Seams, WhereUvAreSharedThereIsNone) {
  EXPECT_TRUE(seams_of(square(kLowerRight, {Vec2{0, 0}, Vec2{0.4f, 0.4f}, Vec2{0, 0.4f}})).empty());
}

TEST(Seams, OnlyTheOwnChartAndWhatIsNearIsAnswered) {
  const Seams seams = seams_of(square(kLowerRight, {Vec2{0.6f, 0.6f}, Vec2{0.9f, 0.9f}, Vec2{0.6f, 0.9f}}));
  EXPECT_TRUE(seams.near({0.2f, 0.1f}, 1, 0.05f).empty());
  EXPECT_TRUE(seams.near({0.39f, 0.01f}, 0, 0.1f).size() <= 1);
  EXPECT_EQ(seams.near({0.75f, 0.8f}, 1, 0.1f).size(), 1u);
}

}  // namespace
}  // namespace redmap
