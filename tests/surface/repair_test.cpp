// Repairs: what was broken on purpose is whole again, and what was whole is left alone.
#include <gtest/gtest.h>

#include "base/random.h"
#include "shapes.h"
#include "surface/prepare.h"
#include "surface/repair.h"

namespace redmap {
namespace {

double volume(const TriangleMesh& mesh) {
  double sum = 0;
  for (const auto& [a, b, c] : mesh.triangles)
    sum += double(dot(mesh.positions[a], cross(mesh.positions[b], mesh.positions[c]))) / 6;
  return sum;
}

/// Boundary and non-manifold edges, as prepare() counts them.
PrepareReport edges_of(TriangleMesh mesh) { return prepare(mesh, {}); }

TEST(Repair, AWholeMeshIsLeftAsItIs) {
  const TriangleMesh before = bumpy_sphere(2);
  TriangleMesh mesh = before;
  const RepairReport report = repair(mesh);
  EXPECT_EQ(mesh.triangles, before.triangles);
  EXPECT_EQ(mesh.positions, before.positions);
  EXPECT_EQ(report.turned_triangles + report.split_vertices + report.filled_holes, 0u);
}

TEST(Repair, TrianglesTurnedAtRandomFaceOutwardsAgain) {
  const TriangleMesh before = bumpy_sphere(2);
  TriangleMesh mesh = before;
  std::size_t turned = 0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    if (hash64(7, t) % 3 > 0) std::swap(mesh.triangles[t][1], mesh.triangles[t][2]), ++turned;
  EXPECT_EQ(repair(mesh).turned_triangles, turned);
  EXPECT_NEAR(volume(mesh), volume(before), 1e-4);
  EXPECT_EQ(edges_of(mesh).non_manifold_edges, 0u);
}

TEST(Repair, SmallHolesAreFilled_WithTheRightSideOut) {
  const TriangleMesh whole = icosphere(3);
  TriangleMesh mesh = whole;
  // The triangles around vertex 0 and around vertex 3, and one more somewhere else.
  std::erase_if(mesh.triangles, [&](const Triangle& t) {
    return std::any_of(t.begin(), t.end(), [](std::uint32_t v) { return v == 0 || v == 3; });
  });
  mesh.triangles.erase(mesh.triangles.begin() + 400);
  const RepairReport report = repair(mesh);
  EXPECT_EQ(report.filled_holes, 3u);
  EXPECT_EQ(report.filling_triangles, 3u + 3u + 1u) << "two pentagons and a triangle";
  EXPECT_EQ(edges_of(mesh).boundary_edges, 0u);
  EXPECT_NEAR(volume(mesh), volume(whole), 0.01 * volume(whole));
}

TEST(Repair, OpenSheetsStayOpen) {
  for (TriangleMesh sheet : {square(1), square(8)}) {
    const std::size_t before = sheet.triangles.size();
    EXPECT_EQ(repair(sheet).filled_holes, 0u);
    EXPECT_EQ(sheet.triangles.size(), before);
  }
  // Half a sphere is a bowl, not a ball with a hole.
  TriangleMesh bowl = icosphere(3);
  std::erase_if(bowl.triangles, [&](const Triangle& t) { return bowl.positions[t[0]].y > 0; });
  EXPECT_EQ(repair(bowl, 1000).filled_holes, 0u);
}

TEST(Repair, SheetsThatShareAnEdgeOrAPointComeApart) {
  // Two tetrahedra that share the edge 0-1, and a third that shares vertex 0 only.
  TriangleMesh mesh;
  mesh.positions = {{0, 0, 0},  {0, 0, 1},  {1, 0, 0},  {0, 1, 0}, {-1, 0, 0},
                    {0, -1, 0}, {1, 1, -1}, {2, 1, -1}, {1, 2, -1}};
  const auto add = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
    mesh.triangles.insert(mesh.triangles.end(), {{a, c, b}, {a, b, d}, {b, c, d}, {c, a, d}});
  };
  add(0, 2, 3, 1), add(0, 4, 5, 1), add(6, 7, 8, 0);
  EXPECT_GT(edges_of(mesh).non_manifold_edges, 0u);
  EXPECT_EQ(repair(mesh).split_vertices, 3u) << "0 twice and 1 once";
  const PrepareReport report = [&] {
    // Without welding, which would join them again.
    PrepareReport counted;
    std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
    for (const Triangle& t : mesh.triangles)
      for (int k = 0; k < 3; ++k) ++edges[std::minmax(t[k], t[(k + 1) % 3])];
    for (const auto& [edge, count] : edges) counted.non_manifold_edges += count != 2;
    return counted;
  }();
  EXPECT_EQ(report.non_manifold_edges, 0u);
}

TEST(Repair, PrepareReportsIt) {
  TriangleMesh mesh = icosphere(2);
  mesh.triangles.erase(mesh.triangles.begin() + 5);
  std::swap(mesh.triangles[9][0], mesh.triangles[9][1]);
  const PrepareReport report = prepare(mesh, {.repair = true});
  EXPECT_EQ(report.repair.filled_holes, 1u);
  EXPECT_EQ(report.repair.turned_triangles, 1u);
  EXPECT_EQ(report.boundary_edges + report.non_manifold_edges, 0u);
}

}  // namespace
}  // namespace redmap
