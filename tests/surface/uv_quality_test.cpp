// Judging uv: squares, where every figure is known.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "shapes.h"
#include "surface/atlas.h"
#include "surface/uv_quality.h"

namespace redmap {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

/// Appends `other`, both with their uv as positions' own indices.
void append(TriangleMesh& mesh, const TriangleMesh& other) {
  const auto first = static_cast<std::uint32_t>(mesh.positions.size());
  mesh.positions.insert(mesh.positions.end(), other.positions.begin(), other.positions.end());
  mesh.uv.insert(mesh.uv.end(), other.uv.begin(), other.uv.end());
  for (const auto& [a, b, c] : other.triangles) mesh.triangles.push_back({a + first, b + first, c + first});
  mesh.uv_triangles = mesh.triangles;
}

/// The square of 2 n^2 triangles with its uv scaled, then moved.
TriangleMesh placed(float scale_u, float scale_v, Vec2 offset) {
  TriangleMesh mesh = square(8);
  for (Vec2& uv : mesh.uv) uv = Vec2{uv.x * scale_u, uv.y * scale_v} + offset;
  return mesh;
}

TEST(UvQuality, ASquareThatCoversItsTileIsUsable) {
  const UvReport report = judge_uv(square(8));
  EXPECT_EQ(report.problem, "");
  EXPECT_THAT(report.tiles, ElementsAre(1001));
  EXPECT_EQ(report.overlapping_texels, 0u);
  EXPECT_NEAR(report.coverage, 1, 0.02) << "centres on edges belong to nobody";
  EXPECT_NEAR(report.density_low, 1, 1e-3);
  EXPECT_NEAR(report.density_high, 1, 1e-3);
}

TEST(UvQuality, OurOwnAtlasIsUsable_WithoutOverlapAtTwiceTheResolution) {
  TriangleMesh mesh = bumpy_sphere(3);
  unwrap(mesh);
  const UvReport report = judge_uv(mesh, 2048);
  EXPECT_EQ(report.problem, "");
  EXPECT_EQ(report.overlapping_texels, 0u);
}

TEST(UvQuality, MirroredHalvesOverlap) {
  TriangleMesh mesh = placed(0.5f, 1, {0, 0});
  append(mesh, placed(-0.5f, 1, {0.5f, 0}));
  const UvReport report = judge_uv(mesh);
  EXPECT_NEAR(static_cast<double>(report.overlapping_texels), 512 * 1024, 0.02 * 512 * 1024);
  EXPECT_EQ(report.mirrored_texels, report.overlapping_texels);
  EXPECT_THAT(report.problem, HasSubstr("uv overlap on "));
  EXPECT_THAT(report.problem, HasSubstr("% of the covered texels, mirrored"));
}

TEST(UvQuality, AQuarterThatOverlapsIsCountedToTheTexel) {
  // Two squares of half the width, shifted by a quarter: a strip of a quarter is common. No edge runs through a centre.
  TriangleMesh mesh = square(1);
  for (Vec2& uv : mesh.uv) uv = {uv.x * 0.5f, uv.y};
  TriangleMesh other = mesh;
  for (Vec2& uv : other.uv) uv = uv + Vec2{0.25f, 0};
  append(mesh, other);
  const UvReport report = judge_uv(mesh);
  EXPECT_NEAR(static_cast<double>(report.overlapping_texels), 256 * 1024, 2 * 1024);
  EXPECT_EQ(report.mirrored_texels, 0u);
}

TEST(UvQuality, DegenerateWastefulAndOutsideAreNamed) {
  TriangleMesh flat = placed(0.5f, 0.5f, {0.25f, 0.25f});
  append(flat, placed(0, 0.5f, {0.9f, 0}));
  EXPECT_THAT(judge_uv(flat).problem, HasSubstr("50 % of the surface have no area in uv"));
  EXPECT_THAT(judge_uv(placed(0, 0, {})).problem, HasSubstr("100 % of the surface"));
  EXPECT_THAT(judge_uv(placed(0.2f, 0.2f, {})).problem, HasSubstr("uv cover only 3.99 % of their tiles"));
  EXPECT_THAT(judge_uv(placed(2.5f, 1, {})).problem, HasSubstr("of 128 triangles lie outside"));
  EXPECT_THAT(judge_uv(placed(1, 1, {-1, 0})).problem, HasSubstr("128 of 128 triangles lie outside"));
  EXPECT_THAT(judge_uv(placed(1, 1, {10, 0})).problem, HasSubstr("128 of 128"));
}

TEST(UvQuality, TilesAreNumberedAsUdim_AndComeApartIntoTheirOwnSquares) {
  TriangleMesh mesh = square(8);
  append(mesh, placed(1, 1, {3, 0}));
  append(mesh, placed(1, 1, {1, 2}));
  const UvReport report = judge_uv(mesh);
  EXPECT_EQ(report.problem, "");
  EXPECT_THAT(report.tiles, ElementsAre(1001, 1004, 1022));
  for (const int tile : report.tiles) {
    const TriangleMesh one = extract_tile(mesh, tile);
    EXPECT_EQ(one.triangles.size(), 128u);
    EXPECT_EQ(judge_uv(one).tiles, std::vector{1001});
    EXPECT_NO_THROW(make_mesh_surface(one));
    const auto surface = make_mesh_surface(one);
    EXPECT_NEAR(surface->uv_area(), 1, 1e-5);
  }
}

}  // namespace
}  // namespace redmap
