#include "atlas/atlas_bench.h"

#include <sys/resource.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <vector>

namespace redmap::bench {
namespace {

/// Texels of a `size` x `size` map whose centre lies inside two triangles or more, in plain double precision: no code
/// in common with what bakes.
std::size_t count_overlaps(const TriangleMesh& mesh, int size) {
  std::vector<std::uint8_t> owners(static_cast<std::size_t>(size) * size);
  for (const Triangle& t : mesh.uv_triangles) {
    double x[3], y[3];
    for (int k = 0; k < 3; ++k) x[k] = double(mesh.uv[t[k]].x) * size, y[k] = double(mesh.uv[t[k]].y) * size;
    const double area = (x[1] - x[0]) * (y[2] - y[0]) - (x[2] - x[0]) * (y[1] - y[0]);
    if (area == 0) continue;
    const auto [left, right] = std::minmax({x[0], x[1], x[2]});
    const auto [bottom, top] = std::minmax({y[0], y[1], y[2]});
    for (int row = static_cast<int>(bottom); row <= std::min<double>(top, size - 1); ++row)
      for (int column = static_cast<int>(left); column <= std::min<double>(right, size - 1); ++column) {
        bool inside = true;
        for (int k = 0; k < 3 && inside; ++k) {
          const int l = (k + 1) % 3;
          const double side = (x[l] - x[k]) * (row + 0.5 - y[k]) - (y[l] - y[k]) * (column + 0.5 - x[k]);
          // Strictly inside: shared edges belong to neither.
          inside = side / area > 1e-9;
        }
        std::uint8_t& count = owners[static_cast<std::size_t>(row) * size + column];
        if (inside && count < 2) ++count;
      }
  }
  return std::count(owners.begin(), owners.end(), 2);
}

/// Quantiles over the surface of the density of texels, relative to the mean.
void measure_density(const TriangleMesh& mesh, AtlasRow& row) {
  std::vector<std::pair<double, double>> density_and_area;
  double area = 0, uv_area = 0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto [a, b, c] = mesh.triangles[t];
    const auto [i, j, k] = mesh.uv_triangles[t];
    const double on_mesh =
        length(cross(mesh.positions[b] - mesh.positions[a], mesh.positions[c] - mesh.positions[a])) / 2;
    const double in_uv = cross(mesh.uv[j] - mesh.uv[i], mesh.uv[k] - mesh.uv[i]) / 2;
    if (on_mesh > 0) density_and_area.emplace_back(in_uv / on_mesh, on_mesh);
    area += on_mesh, uv_area += in_uv;
  }
  std::sort(density_and_area.begin(), density_and_area.end());
  double below = 0;
  for (const auto& [density, on_mesh] : density_and_area) {
    if (below <= 0.05 * area) row.area_q05 = density * area / uv_area;
    if (below <= 0.95 * area) row.area_q95 = density * area / uv_area;
    below += on_mesh;
  }
}

/// The other atlas starts from half as many charts again, so that hardly a seam stays where it was.
FarError measure_both_atlases(TriangleMesh mesh, int size) {
  TriangleMesh recut = mesh;
  unwrap(recut, {.charts = 3 * AtlasOptions{}.charts / 2, .resolution = size});
  return measure_far_error(*make_mesh_surface(std::move(mesh)), *make_mesh_surface(std::move(recut)), size);
}

}  // namespace

AtlasRow measure_atlas(const std::filesystem::path& path, int size, bool with_far_errors) {
  AtlasRow row;
  row.mesh = path.filename().string();
  TriangleMesh mesh = read_mesh(path);
  row.triangles = mesh.triangles.size();
  const auto start = std::chrono::steady_clock::now();
  row.atlas = unwrap(mesh, {.resolution = size});
  row.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  row.peak_bytes = static_cast<std::uint64_t>(usage.ru_maxrss) * 1024;
  measure_density(mesh, row);
  row.overlap_texels = count_overlaps(mesh, 2 * size);
  if (with_far_errors) row.far = measure_both_atlases(std::move(mesh), size);
  return row;
}

}  // namespace redmap::bench
