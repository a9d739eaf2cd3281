// Crumbs are merged, up to the limits.
#include "surface/chart_merging.h"

#include <gtest/gtest.h>

#include <numeric>

#include "shapes.h"

namespace redmap {
namespace {

/// Every triangle a chart of its own.
std::vector<FlatChart> crumbs(const TriangleMesh& mesh, const FaceGraph& graph) {
  std::vector<FlatChart> charts;
  for (int face = 0; face < graph.size(); ++face) {
    charts.push_back(cut_chart(mesh, graph, {face}));
    EXPECT_TRUE(flatten(charts.back()) && is_sound(charts.back(), 1.25));
  }
  return charts;
}

TEST(ChartMerging, CrumbsBecomeFewSoundCharts_WithEveryFaceInOne) {
  const TriangleMesh mesh = bumpy_sphere(2);
  const FaceGraph graph = make_face_graph(mesh);
  std::vector<FlatChart> charts = crumbs(mesh, graph);
  const double area = std::accumulate(graph.areas.begin(), graph.areas.end(), 0.0);
  merge_charts(mesh, graph, area / 10, 1.25, charts);
  EXPECT_LT(charts.size(), 60u);
  EXPECT_GE(charts.size(), 10u);
  std::vector<int> owners(graph.areas.size());
  for (FlatChart& chart : charts) {
    EXPECT_TRUE(is_disk(chart) && is_sound(chart, 1.25));
    EXPECT_LE(chart.area, area / 10);
    for (const int face : chart.faces) ++owners[face];
  }
  for (const int owner_count : owners) EXPECT_EQ(owner_count, 1);
}

TEST(ChartMerging, NothingIsMergedAcrossTheStretchLimit) {
  // On an icosahedron any two faces unfold without stretch; five around a corner as well, but no closed fan of five.
  const TriangleMesh mesh = icosphere(0);
  const FaceGraph graph = make_face_graph(mesh);
  std::vector<FlatChart> charts = crumbs(mesh, graph);
  const double area = std::accumulate(graph.areas.begin(), graph.areas.end(), 0.0);
  merge_charts(mesh, graph, area, 1 + 1e-6, charts);
  EXPECT_LT(charts.size(), 20u);
  for (const FlatChart& chart : charts) EXPECT_NEAR(chart.stretch_times_area / chart.area, 1, 3e-6);
}

}  // namespace
}  // namespace redmap
