// An atlas in five steps: grow charts, flatten them, split what is not sound, merge crumbs, pack.
#include "surface/atlas.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/error.h"
#include "base/parallel.h"
#include "surface/chart_growing.h"
#include "surface/chart_merging.h"
#include "surface/chart_packing.h"
#include "surface/face_graph.h"
#include "surface/flat_chart.h"
#include "surface/part_density.h"

namespace redmap {

namespace {

// Tuned on the 10k bunny and the 20k dragon: less compactness makes ragged charts that pack badly, more cuts across
// flat places; after 15 rounds charts hardly move.
constexpr double kCompactness = 3, kSplitCompactness = 10;
constexpr int kRounds = 15, kSplitRounds = 8;

// Charts are merged up to this many times the area that a chart was to have, as long as the stretch stays below the
// limit. On the 20k dragon this leaves 48 charts at an L2 stretch of 1.022, with two thirds of the boundary.
constexpr double kLarge = 6, kMergedL2Stretch = 1.1;

// Large meshes start from more charts, since flattening one takes more than proportionally longer.
constexpr int kFacesPerChart = 5000;

void check(const TriangleMesh& mesh, const FaceGraph& graph, const AtlasOptions& options) {
  if (mesh.triangles.empty()) throw Error("atlas: expected a mesh with triangles, found none");
  if (options.charts < 1 || options.cell_texels < 1 || options.gutter_texels < 0 ||
      options.resolution < options.cell_texels || !(options.max_l2_stretch >= 1))
    throw Error(
        "atlas: expected charts and cell_texels of 1 or more, gutter_texels of 0 or more, resolution of a cell or more "
        "and max_l2_stretch of 1 or more, found {}, {}, {}, {}, {}",
        options.charts, options.cell_texels, options.gutter_texels, options.resolution, options.max_l2_stretch);
  for (int f = 0; f < graph.size(); ++f)
    if (!(graph.areas[f] > 0) || !std::isfinite(graph.areas[f]))
      throw Error("atlas: triangle {}: expected a finite area above 0, found {}", f, graph.areas[f]);
}

/// Two halves, by shape where that works and by order where not.
std::vector<std::vector<int>> split(const FaceGraph& graph, const std::vector<int>& faces) {
  const FaceGraph part = subgraph(graph, faces);
  std::vector<std::vector<int>> halves = connected_parts(part, grow_charts(part, 2, kSplitCompactness, kSplitRounds));
  if (halves.size() < 2) {
    std::vector<int> labels(faces.size());
    for (std::size_t i = faces.size() / 2; i < labels.size(); ++i) labels[i] = 1;
    halves = connected_parts(part, labels);
  }
  for (std::vector<int>& half : halves)
    for (int& face : half) face = faces[face];
  return halves;
}

/// Flattens all charts, splitting those that are not sound until all are. A chart of one triangle always is.
std::vector<FlatChart> flatten_all(const TriangleMesh& mesh, const FaceGraph& graph,
                                   std::vector<std::vector<int>> pending, double max_l2_stretch) {
  std::vector<FlatChart> done;
  while (!pending.empty()) {
    std::vector<FlatChart> charts(pending.size());
    std::vector<std::vector<std::vector<int>>> halves(pending.size());
    parallel_for(pending.size(), [&](std::size_t i) {
      charts[i] = cut_chart(mesh, graph, pending[i]);
      const bool sound = is_disk(charts[i]) && flatten(charts[i]) && is_sound(charts[i], max_l2_stretch);
      if (!sound && pending[i].size() > 1) halves[i] = split(graph, pending[i]);
    });
    pending.clear();
    for (std::size_t i = 0; i < charts.size(); ++i) {
      if (halves[i].empty()) done.push_back(std::move(charts[i]));
      for (std::vector<int>& half : halves[i]) pending.push_back(std::move(half));
    }
  }
  return done;
}

/// Larger cells for large maps: on a finer grid packing gains nothing and takes minutes.
int cell_texels(const AtlasOptions& options) {
  constexpr int kMostCells = 512;  // across; what cells of 4 make of 2048 texels
  int texels = options.cell_texels;
  while (options.resolution / texels > kMostCells) texels *= 2;
  return texels;
}

void write_uv(const std::vector<FlatChart>& charts, const Packing& packing, int resolution, TriangleMesh& mesh) {
  mesh.uv.clear();
  mesh.uv_triangles.assign(mesh.triangles.size(), {});
  for (std::size_t i = 0; i < charts.size(); ++i) {
    const auto first = static_cast<std::uint32_t>(mesh.uv.size());
    for (const Eigen::Vector2d& point : charts[i].plane) {
      const Eigen::Vector2d uv = place(packing.placements[i], packing.scale, point) / resolution;
      mesh.uv.push_back({static_cast<float>(uv.x()), static_cast<float>(uv.y())});
    }
    for (std::size_t f = 0; f < charts[i].faces.size(); ++f)
      for (int k = 0; k < 3; ++k) mesh.uv_triangles[charts[i].faces[f]][k] = first + charts[i].triangles[f][k];
  }
}

AtlasReport measure(const std::vector<FlatChart>& charts, const TriangleMesh& mesh) {
  AtlasReport report{.charts = static_cast<int>(charts.size())};
  double area = 0, stretch = 0;
  for (const FlatChart& chart : charts) area += chart.area, stretch += chart.stretch_times_area;
  report.l2_stretch = std::sqrt(stretch / area);
  // Rounding uv to float may turn a sliver over; below this (a thousandth of a texel of 1024 x 1024) nobody sees it.
  constexpr double kInvisibleArea = 1e-9;
  for (const Triangle& t : mesh.uv_triangles) {
    const double twice_area = cross(mesh.uv[t[1]] - mesh.uv[t[0]], mesh.uv[t[2]] - mesh.uv[t[0]]);
    report.packing += std::abs(twice_area) / 2;
    report.flips += twice_area < -2 * kInvisibleArea;
  }
  return report;
}

}  // namespace

AtlasReport unwrap(TriangleMesh& mesh, const AtlasOptions& options) {
  FaceGraph graph = make_face_graph(mesh);
  check(mesh, graph, options);
  const std::vector<float> densities = triangle_densities(mesh, options.part_density);
  cut_between_densities(densities, graph);
  const int count = std::max(options.charts, graph.size() / kFacesPerChart);
  const std::vector<int> labels = grow_charts(graph, count, kCompactness, kRounds);
  std::vector<FlatChart> charts = flatten_all(mesh, graph, connected_parts(graph, labels), options.max_l2_stretch);
  const double area = std::accumulate(graph.areas.begin(), graph.areas.end(), 0.0);
  merge_charts(mesh, graph, kLarge * area / count, std::min(kMergedL2Stretch, options.max_l2_stretch), charts);
  for (FlatChart& chart : charts)
    for (Eigen::Vector2d& point : chart.plane) point *= densities[chart.faces.front()];
  const std::optional<Packing> packing =
      pack_charts(charts, options.resolution, cell_texels(options), options.gutter_texels);
  if (!packing)
    throw Error("atlas: {} charts do not fit {} x {} texels in cells of {}: raise the resolution", charts.size(),
                options.resolution, options.resolution, options.cell_texels);
  write_uv(charts, *packing, options.resolution, mesh);
  const AtlasReport report = measure(charts, mesh);
  if (report.flips > 0) throw Error("atlas: expected no flipped triangles, found {}", report.flips);
  return report;
}

}  // namespace redmap
