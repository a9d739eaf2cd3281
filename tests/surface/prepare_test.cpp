// Meshes brought to a size: closed ones stay closed, known shapes keep their measures.
#include "surface/prepare.h"

#include <gtest/gtest.h>

#include "base/error.h"
#include "shapes.h"

namespace redmap {
namespace {

double area_of(const TriangleMesh& mesh) {
  double area = 0;
  for (const auto& [a, b, c] : mesh.triangles)
    area += 0.5 * length(cross(mesh.positions[b] - mesh.positions[a], mesh.positions[c] - mesh.positions[a]));
  return area;
}

TEST(Prepare, ClosedMeshesGetTheirNumberOfTriangles_AndStayClosed) {
  for (const std::size_t triangles : {300u, 2000u}) {
    TriangleMesh mesh = bumpy_sphere(2);  // 320 triangles
    const PrepareReport report = prepare(mesh, {.triangles = triangles});
    EXPECT_NEAR(double(report.triangles), double(triangles), 0.02 * double(triangles));
    EXPECT_EQ(report.triangles, mesh.triangles.size());
    EXPECT_EQ(report.boundary_edges, 0u);
    EXPECT_EQ(report.non_manifold_edges, 0u);
    // Euler: V - E + F = 2 with E = 3 F / 2.
    EXPECT_EQ(report.vertices, report.triangles / 2 + 2);
    EXPECT_EQ(report.subdivisions, triangles == 300u ? 0 : 2);
  }
}

TEST(Prepare, LoopSubdivisionOfASquareStaysFlat_AndRoundsItsCornersByTheBoundaryRule) {
  const TriangleMesh flat = square(2), finer = subdivide_loop(flat);
  EXPECT_EQ(finer.triangles.size(), 4 * flat.triangles.size());
  // (3 (0, 0) + ((.5, 0) + (0, .5)) / 2) / 4 = (1, 1) / 16: a corner loses 2 * (1/4 * 1/16) / 2 = 1/64.
  EXPECT_NEAR(area_of(finer), 1 - 4.0 / 64, 1e-6);
  for (const Vec3 p : finer.positions) EXPECT_EQ(p.z, 0);
}

TEST(Prepare, LoopSubdivisionOfARegularRingKeepsLinearFunctions) {
  // Inner vertices of valence 6 reproduce planes exactly, in position too.
  const TriangleMesh flat = square(4), finer = subdivide_loop(flat);
  const std::size_t centre = 2 * 5 + 2;
  EXPECT_NEAR(length(finer.positions[centre] - flat.positions[centre]), 0, 1e-6f);
}

TEST(Prepare, EqualVerticesAreWelded) {
  TriangleMesh mesh = icosphere(2), loose;
  for (const Triangle& t : mesh.triangles) {
    const auto first = static_cast<std::uint32_t>(loose.positions.size());
    for (const std::uint32_t vertex : t) loose.positions.push_back(mesh.positions[vertex]);
    loose.triangles.push_back({first, first + 1, first + 2});
  }
  const PrepareReport report = prepare(loose, {});
  EXPECT_EQ(report.vertices, mesh.positions.size());
  EXPECT_EQ(report.boundary_edges, 0u);
}

TEST(Prepare, NearVerticesAreWeldedOnlyWhenAskedFor) {
  TriangleMesh mesh = square(1);
  mesh.triangles[1] = {0, 4, 2};
  mesh.positions.push_back(mesh.positions[3] + Vec3{1e-4f, 0, 0});
  TriangleMesh welded = mesh;
  EXPECT_EQ(prepare(mesh, {}).welded_vertices, 0u);
  EXPECT_EQ(prepare(welded, {.weld_distance = 1e-3f}).welded_vertices, 1u);
}

TEST(Prepare, FinsVanish_DoublesStayOnce) {
  TriangleMesh mesh = icosphere(1);
  const std::size_t before = mesh.triangles.size();
  mesh.positions.push_back({3, 0, 0});
  const std::uint32_t tip = static_cast<std::uint32_t>(mesh.positions.size() - 1);
  mesh.triangles.push_back({0, 1, tip}), mesh.triangles.push_back({1, 0, tip});
  mesh.triangles.push_back(mesh.triangles[7]);
  const PrepareReport report = prepare(mesh, {});
  EXPECT_EQ(report.triangles, before);
  EXPECT_EQ(report.dropped_triangles, 3u);
  EXPECT_EQ(report.boundary_edges + report.non_manifold_edges, 0u);
}

TEST(Prepare, OnlyTheLargestPartStays) {
  TriangleMesh mesh = icosphere(1);
  const TriangleMesh small = icosphere(0);
  for (const Triangle& t : small.triangles) mesh.triangles.push_back({t[0] + 42, t[1] + 42, t[2] + 42});
  for (const Vec3 p : small.positions) mesh.positions.push_back(p + Vec3{5, 0, 0});
  EXPECT_EQ(prepare(mesh, {.largest_part = true}).dropped_triangles, 20u);
  EXPECT_EQ(mesh.positions.size(), 42u);
}

TEST(Prepare, UnitSphereIsFilledExactly) {
  TriangleMesh mesh = bumpy_sphere(3);
  for (Vec3& p : mesh.positions) p = p * 7 + Vec3{100, -20, 3};
  prepare(mesh, {.unit_sphere = true});
  float largest = 0;
  for (const Vec3 p : mesh.positions) largest = std::max(largest, length(p));
  EXPECT_NEAR(largest, 1, 1e-6f);
}

TEST(Prepare, NothingLeftIsAnError) {
  TriangleMesh empty, degenerate;
  degenerate.positions = {{0, 0, 0}, {0, 0, 0}, {1, 0, 0}};
  degenerate.triangles = {{0, 1, 2}};
  EXPECT_THROW(prepare(empty, {}), Error);
  EXPECT_THROW(prepare(degenerate, {}), Error);
}

}  // namespace
}  // namespace redmap
