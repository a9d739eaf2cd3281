// Places evenly spaced along the cumulated area of the triangles, spread within each by the R2 sequence (Roberts 2018).
#include "bake/surface_cells.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "base/parallel.h"
#include "surface/mesh.h"

namespace redmap {
namespace {

/// Leaves a third as wide as the footprints that clusters serve alone (cluster_part()); 16 halve the error there once
/// more, 64 double it.
constexpr double kTexelsPerLeaf = 32;
constexpr std::size_t kCellsPerLeaf = 16, kMostLeaves = std::size_t{1} << 18;

/// Of the triangles at rest, whatever the pose.
std::vector<double> cumulated_areas(const Surface& surface) {
  std::vector<double> sums(surface.mesh()->triangles.size());
  double sum = 0;
  for (std::size_t t = 0; t < sums.size(); ++t) {
    const auto triangle = static_cast<std::uint32_t>(t);
    const HitCoordinates corners[3] = {{triangle, {0, 0}}, {triangle, {1, 0}}, {triangle, {0, 1}}};
    SurfaceHit at[3];
    surface.complete(corners, at);
    sum += 0.5 * length(cross(at[1].rest.position - at[0].rest.position, at[2].rest.position - at[0].rest.position));
    sums[t] = sum;
  }
  return sums;
}

/// Barycentric weights of vertices 1 and 2, the i-th of a sequence that fills the triangle evenly.
Vec2 spread_in_triangle(std::size_t i) {
  constexpr double kPlastic = 1.32471795724474602596;  // its powers spread best in the square
  double u = std::fmod(0.5 + static_cast<double>(i) / kPlastic, 1.0);
  double v = std::fmod(0.5 + static_cast<double>(i) / (kPlastic * kPlastic), 1.0);
  if (u + v > 1) u = 1 - u, v = 1 - v;
  return {static_cast<float>(u), static_cast<float>(v)};
}

/// The texel of `level` that holds `uv`.
void read_weights(const WeightPyramid& weights, int level, Vec2 uv, float* out) {
  const Extent extent = weights.extent(level);
  const int x = std::clamp(static_cast<int>(uv.x * static_cast<float>(extent.width)), 0, extent.width - 1);
  const int y = std::clamp(static_cast<int>(uv.y * static_cast<float>(extent.height)), 0, extent.height - 1);
  for (int c = 0; c < weights.channels(); ++c) out[c] = weights.value(level, x, y, c);
}

}  // namespace

SurfaceClusters build_clusters(const Surface& surface, const WeightPyramid& weights) {
  if (!surface.mesh()) return {};
  const Extent extent = weights.extent(0);
  const double texels = surface.uv_area() * extent.width * extent.height;
  const std::size_t leaves =
      std::min(kMostLeaves, std::bit_floor(static_cast<std::size_t>(std::max(1.0, texels / kTexelsPerLeaf))));
  const std::size_t count = leaves * kCellsPerLeaf;
  const std::vector<double> sums = cumulated_areas(surface);
  const double cell_area = sums.back() / static_cast<double>(count);

  // Level 1: two texels across, about as wide as a cell, and within the cells that charts do not share.
  const int level = std::min(1, weights.levels() - 1);
  std::vector<ClusterPlace> cells(count);
  std::vector<float> values(count * weights.channels());
  parallel_for(count, [&](std::size_t i) {
    const double area = (static_cast<double>(i) + 0.5) * cell_area;
    const std::size_t t =
        std::min<std::size_t>(std::lower_bound(sums.begin(), sums.end(), area) - sums.begin(), sums.size() - 1);
    SurfaceHit hit;
    const HitCoordinates where{static_cast<std::uint32_t>(t), spread_in_triangle(i)};
    surface.complete({&where, 1}, {&hit, 1});
    // As a disc of its area.
    const float radius = static_cast<float>(std::sqrt(cell_area / kPi));
    cells[i] = {hit.rest.position, hit.rest.normal, radius, 0.5f * radius * radius};
    read_weights(weights, level, hit.uv, &values[i * weights.channels()]);
  });
  return SurfaceClusters::build(cells, values, weights.channels(), leaves);
}

}  // namespace redmap
