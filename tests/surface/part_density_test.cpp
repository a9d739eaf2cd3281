// Texels where they are wanted: a torus of two groups, one four times as dense.
#include "surface/part_density.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/error.h"
#include "base/temporary_folder.h"
#include "surface/atlas.h"
#include "surface/charts.h"
#include "surface/shapes.h"

namespace redmap {
namespace {

template <typename Body>
std::string error_of(Body&& body) {
  try {
    body();
  } catch (const Error& error) {
    return error.what();
  }
  return "no error";
}

TriangleMesh two_part_torus() {
  TriangleMesh mesh = torus(48, 24, 1, 0.4f);
  mesh.parts = {{"plain", "rubber"}, {"fine", "rubber"}};
  for (const Triangle& t : mesh.triangles) mesh.triangle_parts.push_back(mesh.positions[t[0]].x > 0);
  return mesh;
}

/// Texels along a length on each part, relative.
std::array<double, 2> densities_of(const TriangleMesh& mesh) {
  double on_mesh[2] = {}, in_uv[2] = {};
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto [a, b, c] = mesh.triangles[t];
    const auto [i, j, k] = mesh.uv_triangles[t];
    on_mesh[mesh.triangle_parts[t]] +=
        length(cross(mesh.positions[b] - mesh.positions[a], mesh.positions[c] - mesh.positions[a]));
    in_uv[mesh.triangle_parts[t]] += cross(mesh.uv[j] - mesh.uv[i], mesh.uv[k] - mesh.uv[i]);
  }
  return {std::sqrt(in_uv[0] / on_mesh[0]), std::sqrt(in_uv[1] / on_mesh[1])};
}

TEST(PartDensity, OnePartHasFourTimesTheTexelsAlongALength_WithinChartsOfItsOwn) {
  TriangleMesh mesh = two_part_torus();
  const AtlasReport report = unwrap(mesh, {.part_density = {{"fine", 4.0f}}});
  EXPECT_EQ(report.flips, 0);
  EXPECT_LT(report.l2_stretch, 1.05);
  const auto [plain, fine] = densities_of(mesh);
  EXPECT_NEAR(fine / plain, 4, 0.05);
  const std::vector<std::uint32_t> charts = find_charts(mesh);
  std::vector<int> part_of_chart(charts.size(), -1);
  for (std::size_t t = 0; t < charts.size(); ++t) {
    int& part = part_of_chart[charts[t]];
    if (part < 0) part = static_cast<int>(mesh.triangle_parts[t]);
    EXPECT_EQ(part, static_cast<int>(mesh.triangle_parts[t]));
  }
}

TEST(PartDensity, TheGroupGoesBeforeTheMaterial) {
  const std::vector<float> densities = triangle_densities(two_part_torus(), {{"rubber", 0.5f}, {"fine", 3.0f}});
  const TriangleMesh mesh = two_part_torus();
  for (std::size_t t = 0; t < densities.size(); ++t) EXPECT_EQ(densities[t], mesh.triangle_parts[t] == 1 ? 3.0f : 0.5f);
}

TEST(PartDensity, EvenDensityIsTheAtlasOfBefore) {
  TriangleMesh plain = two_part_torus(), weighted = plain;
  unwrap(plain);
  unwrap(weighted, {.part_density = {{"fine", 1.0f}}});
  EXPECT_EQ(plain.uv, weighted.uv);
}

TEST(PartDensity, UnknownPartsAndZeroAreRefused) {
  TriangleMesh mesh = two_part_torus();
  EXPECT_THAT(error_of([&] { unwrap(mesh, {.part_density = {{"fin", 2.0f}}}); }), testing::HasSubstr("fine"));
  EXPECT_THAT(error_of([&] { unwrap(mesh, {.part_density = {{"fine", 0.0f}}}); }), testing::HasSubstr("above 0"));
}

TEST(PartDensity, AtlasesOfOtherDensitiesAreNotTakenFromTheCache) {
  const TemporaryFolder folder;
  TriangleMesh even = two_part_torus(), weighted = even;
  unwrap_cached(even, folder / "cache");
  unwrap_cached(weighted, folder / "cache", {.part_density = {{"fine", 2.0f}}});
  const auto [plain, fine] = densities_of(weighted);
  EXPECT_NEAR(fine / plain, 2, 0.05);
}

}  // namespace
}  // namespace redmap
