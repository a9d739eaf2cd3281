// What must hold for every atlas: each place of the mesh has its own texels, nothing is flipped or stretched, and the
// result does not depend on threads.
#include "surface/atlas.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "base/error.h"
#include "base/parallel.h"
#include "shapes.h"
#include "surface/charts.h"
#include "surface/surface.h"
#include "temporary_folder.h"

namespace redmap {
namespace {

struct NamedMesh {
  const char* name;
  TriangleMesh mesh;
};

std::vector<NamedMesh> closed_meshes() {
  return {{"bumpy sphere", bumpy_sphere(4)}, {"torus", torus(64, 32, 1, 0.4f)}, {"tetrahedral sphere", icosphere(0)}};
}

/// The triangles whose inside holds each texel's centre, by brute force: an implementation of its own.
std::vector<std::vector<std::uint32_t>> triangles_of_texels(const TriangleMesh& mesh, int size) {
  std::vector<std::vector<std::uint32_t>> owners(std::size_t(size) * size);
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    double x[3], y[3];
    for (int k = 0; k < 3; ++k) {
      x[k] = double(mesh.uv[mesh.uv_triangles[t][k]].x) * size;
      y[k] = double(mesh.uv[mesh.uv_triangles[t][k]].y) * size;
    }
    const double area = (x[1] - x[0]) * (y[2] - y[0]) - (x[2] - x[0]) * (y[1] - y[0]);
    for (int row = int(std::min({y[0], y[1], y[2]})); row <= int(std::max({y[0], y[1], y[2]})) && row < size; ++row)
      for (int column = int(std::min({x[0], x[1], x[2]})); column <= int(std::max({x[0], x[1], x[2]})) && column < size;
           ++column) {
        bool inside = true;
        for (int k = 0; k < 3; ++k) {
          const int l = (k + 1) % 3;
          const double side = (x[l] - x[k]) * (row + 0.5 - y[k]) - (y[l] - y[k]) * (column + 0.5 - x[k]);
          // Strictly inside: shared edges belong to neither.
          inside = inside && side / area > 1e-9;
        }
        if (inside) owners[std::size_t(row) * size + column].push_back(t);
      }
  }
  return owners;
}

TEST(Atlas, NoTexelHasTwoOwners_AtTwiceTheResolution) {
  for (auto& [name, mesh] : closed_meshes()) {
    const AtlasOptions options{.charts = 12, .resolution = 256};
    const AtlasReport report = unwrap(mesh, options);
    EXPECT_EQ(report.flips, 0) << name;
    std::size_t covered = 0;
    for (const auto& owners : triangles_of_texels(mesh, 2 * options.resolution)) {
      ASSERT_LE(owners.size(), 1u) << name;
      covered += owners.size();
    }
    const double texels = 4.0 * options.resolution * options.resolution;
    EXPECT_NEAR(double(covered) / texels, report.packing, 0.01) << name;
  }
}

/// The models of the tables in docs/atlas.md are fetched, not committed: nothing to test where they are not.
TEST(Atlas, BunnyAndDragonFillTwoThirds_WithoutStretchFlipOrOverlap) {
  const std::pair<const char*, double> cases[] = {{"bunny_10k.obj", 1.02}, {"dragon_20k.obj", 1.05}};
  for (const auto& [name, max_l2_stretch] : cases) {
    const std::filesystem::path path = std::filesystem::path(REDMAP_MODELS) / name;
    if (!std::filesystem::exists(path)) continue;
    TriangleMesh mesh = read_mesh(path);
    const AtlasReport report = unwrap(mesh);
    EXPECT_LE(report.l2_stretch, max_l2_stretch) << name;
    EXPECT_GE(report.packing, 0.65) << name;
    EXPECT_EQ(report.flips, 0) << name;
    for (const auto& owners : triangles_of_texels(mesh, 2 * AtlasOptions{}.resolution)) ASSERT_LE(owners.size(), 1u);
  }
}

TEST(Atlas, ChartsNeverShareACell_NorComeNearerThanTheGutter) {
  for (auto& [name, mesh] : closed_meshes()) {
    const AtlasOptions options{.charts = 12, .resolution = 256, .cell_texels = 4, .gutter_texels = 1};
    unwrap(mesh, options);
    const std::vector<std::uint32_t> charts = find_charts(mesh);
    const auto owners = triangles_of_texels(mesh, options.resolution);
    const auto chart_at = [&](int x, int y) -> std::int64_t {
      const auto& here = owners[std::size_t(y) * options.resolution + x];
      return here.empty() ? -1 : std::int64_t{charts[here[0]]};
    };
    for (int y = 0; y < options.resolution; ++y)
      for (int x = 0; x < options.resolution; ++x) {
        if (chart_at(x, y) < 0) continue;
        // The texel, its gutter, and the rest of its cell.
        const int cell_x = x / 4 * 4, cell_y = y / 4 * 4;
        for (int v = std::max(0, std::min(cell_y, y - 1)); v <= std::min(255, std::max(cell_y + 3, y + 1)); ++v)
          for (int u = std::max(0, std::min(cell_x, x - 1)); u <= std::min(255, std::max(cell_x + 3, x + 1)); ++u)
            ASSERT_TRUE(chart_at(u, v) < 0 || chart_at(u, v) == chart_at(x, y)) << name << " " << x << " " << y;
      }
  }
}

TEST(Atlas, EveryTriangleHasItsShareOfTheSquare_Unflipped) {
  for (auto& [name, mesh] : closed_meshes()) {
    const AtlasReport report = unwrap(mesh, {.charts = 20, .resolution = 512});
    ASSERT_EQ(mesh.uv_triangles.size(), mesh.triangles.size());
    double area = 0, uv_area = 0;
    std::vector<double> ratios;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
      const auto& [i, j, k] = mesh.triangles[t];
      const auto& [a, b, c] = mesh.uv_triangles[t];
      const double in_uv = 0.5 * cross(mesh.uv[b] - mesh.uv[a], mesh.uv[c] - mesh.uv[a]);
      const double on_mesh =
          0.5 * length(cross(mesh.positions[j] - mesh.positions[i], mesh.positions[k] - mesh.positions[i]));
      ASSERT_GT(in_uv, 0) << name;
      area += on_mesh, uv_area += in_uv;
      ratios.push_back(in_uv / on_mesh);
    }
    EXPECT_NEAR(uv_area, report.packing, 1e-4);
    EXPECT_LT(report.l2_stretch, 1.05) << name;
    EXPECT_GE(report.l2_stretch, 0.999) << name;
    EXPECT_GT(report.packing, 0.35) << name;
    std::sort(ratios.begin(), ratios.end());
    EXPECT_GT(ratios[ratios.size() / 20], 0.6 * uv_area / area) << name;
    EXPECT_LT(ratios[ratios.size() * 19 / 20], 1.6 * uv_area / area) << name;
  }
}

TEST(Atlas, AnIcosahedronIsUnfoldedWithoutStretch) {
  TriangleMesh mesh = icosphere(0);
  const AtlasReport report = unwrap(mesh, {.charts = 20, .max_l2_stretch = 1 + 1e-6, .resolution = 512});
  EXPECT_LT(report.charts, 20);
  EXPECT_NEAR(report.l2_stretch, 1, 1e-6);
}

TEST(Atlas, StretchLimitIsKept_BySplitting) {
  TriangleMesh loose = bumpy_sphere(3), tight = loose;
  const AtlasReport few = unwrap(loose, {.charts = 2, .max_l2_stretch = 3});
  const AtlasReport many = unwrap(tight, {.charts = 2, .max_l2_stretch = 1.001});
  EXPECT_GT(many.charts, few.charts);
  EXPECT_LE(many.l2_stretch, 1.001);
}

TEST(Atlas, UnsharedVerticesGiveTheSameCharts) {
  TriangleMesh shared = bumpy_sphere(3), loose;
  for (const Triangle& t : shared.triangles) {
    const auto first = static_cast<std::uint32_t>(loose.positions.size());
    for (const std::uint32_t vertex : t) loose.positions.push_back(shared.positions[vertex]);
    loose.triangles.push_back({first, first + 1, first + 2});
  }
  const AtlasOptions options{.resolution = 256};
  EXPECT_EQ(unwrap(shared, options).charts, unwrap(loose, options).charts);
  EXPECT_EQ(shared.uv, loose.uv);
}

TEST(Atlas, NonManifoldEdgesComeApart) {
  // Three squares on one edge, like an open book with a page.
  TriangleMesh mesh;
  mesh.positions = {{0, 0, 0}, {0, 1, 0}, {1, 0, 0}, {1, 1, 0}, {-1, 0, 0}, {-1, 1, 0}, {0, 0, 1}, {0, 1, 1}};
  mesh.triangles = {{0, 2, 1}, {2, 3, 1}, {0, 1, 4}, {4, 1, 5}, {0, 1, 6}, {6, 1, 7}};
  EXPECT_EQ(unwrap(mesh, {.charts = 1, .resolution = 64}).charts, 3);
}

TEST(Atlas, IsTheSameForAnyNumberOfThreads) {
  const AtlasOptions options{.resolution = 512};
  TriangleMesh expected = bumpy_sphere(3);
  {
    const ThreadLimit one(1);
    unwrap(expected, options);
  }
  for (const std::size_t threads : {2, 7}) {
    const ThreadLimit limit(threads);
    TriangleMesh mesh = bumpy_sphere(3);
    unwrap(mesh, options);
    EXPECT_EQ(mesh.uv, expected.uv);
    EXPECT_EQ(mesh.uv_triangles, expected.uv_triangles);
  }
}

TEST(Atlas, WhatCannotBeUnwrappedIsRefused) {
  TriangleMesh empty, flat = square(1), fine = icosphere(2);
  flat.positions[1] = flat.positions[0];
  EXPECT_THROW(unwrap(empty), Error);
  EXPECT_THROW(unwrap(flat), Error);
  EXPECT_THROW(unwrap(fine, {.charts = 0}), Error);
  EXPECT_THROW(unwrap(fine, {.charts = 320, .resolution = 16}), Error) << "320 charts in 16 cells";
}

TEST(AtlasCache, RemembersExactly_AndIgnoresWhatIsTruncatedOrChanged) {
  const TemporaryFolder folder;
  const TriangleMesh original = bumpy_sphere(2);
  TriangleMesh expected = original;
  const AtlasOptions options{.charts = 10, .resolution = 128};
  const AtlasReport report = unwrap(expected, options);
  const auto expect_atlas = [&](const char* when) {
    TriangleMesh mesh = original;
    const AtlasReport again = unwrap_cached(mesh, folder / "cache", options);
    EXPECT_EQ(mesh.uv, expected.uv) << when;
    EXPECT_EQ(mesh.uv_triangles, expected.uv_triangles) << when;
    EXPECT_EQ(again.charts, report.charts) << when;
    EXPECT_EQ(again.l2_stretch, report.l2_stretch) << when;
  };
  expect_atlas("first");
  ASSERT_EQ(std::distance(std::filesystem::directory_iterator(folder / "cache"), {}), 1);
  const std::filesystem::path file = std::filesystem::directory_iterator(folder / "cache")->path();
  const std::string bytes = TemporaryFolder::read(file);
  expect_atlas("remembered");
  for (const std::size_t size : {std::size_t{0}, std::size_t{20}, bytes.size() / 2, bytes.size() - 1}) {
    std::filesystem::resize_file(file, size);
    expect_atlas("truncated");
    EXPECT_EQ(TemporaryFolder::read(file), bytes) << "rebuilt";
  }
  std::string changed = bytes;
  changed[changed.size() / 2] ^= 1;
  std::ofstream(file, std::ios::binary) << changed;
  expect_atlas("changed");
}

TEST(AtlasCache, ARememberedAtlasIsReallyRead) {
  const TemporaryFolder folder;
  const TriangleMesh original = bumpy_sphere(2);
  TriangleMesh mesh = original;
  unwrap_cached(mesh, folder.path(), {.charts = 5});
  const auto written = std::filesystem::last_write_time(std::filesystem::directory_iterator(folder.path())->path());
  mesh = original;
  unwrap_cached(mesh, folder.path(), {.charts = 5});
  EXPECT_EQ(written, std::filesystem::last_write_time(std::filesystem::directory_iterator(folder.path())->path()));
  unwrap_cached(mesh, folder.path(), {.charts = 6});
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder.path()), {}), 2) << "options are part of the key";
}

TEST(AtlasCache, AFolderThatCannotBeWrittenOnlyForgets) {
  const TemporaryFolder folder;
  folder.write("file", "in the way");
  TriangleMesh mesh = bumpy_sphere(1);
  EXPECT_NO_THROW(unwrap_cached(mesh, folder / "file"));
  EXPECT_FALSE(mesh.uv.empty());
}

}  // namespace
}  // namespace redmap
