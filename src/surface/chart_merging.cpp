// Greedy, smallest first, a few passes: a chart that grew may find another neighbour.
#include "surface/chart_merging.h"

#include <algorithm>
#include <map>
#include <numeric>
#include <set>

namespace redmap {

namespace {

class Merger {
 public:
  Merger(const TriangleMesh& mesh, const FaceGraph& graph, std::vector<FlatChart>& charts)
      : mesh_(mesh), graph_(graph), charts_(charts), chart_of_face_(graph.areas.size(), -1) {
    for (std::size_t i = 0; i < charts.size(); ++i) label(static_cast<int>(i));
  }

  /// Whether anything was joined.
  bool pass(double largest_area, double max_l2_stretch) {
    std::vector<int> order(charts_.size());
    std::iota(order.begin(), order.end(), 0);
    std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return charts_[a].area < charts_[b].area; });
    bool merged = false;
    for (const int chart : order) {
      if (charts_[chart].faces.empty()) continue;
      for (const int neighbour : best_neighbours(chart)) {
        if (charts_[chart].area + charts_[neighbour].area > largest_area) continue;
        if (failed_.contains({chart, neighbour}) || !join(chart, neighbour, max_l2_stretch)) continue;
        merged = true;
        break;
      }
    }
    return merged;
  }

 private:
  void label(int chart) {
    for (const int face : charts_[chart].faces) chart_of_face_[face] = chart;
  }

  double edge_length(int face, int k) const {
    const Triangle& t = mesh_.triangles[face];
    return length(mesh_.positions[t[k]] - mesh_.positions[t[(k + 1) % 3]]);
  }

  /// The three neighbours with the longest common boundary, longest first.
  std::vector<int> best_neighbours(int chart) const {
    std::map<int, double> common;
    for (const int face : charts_[chart].faces)
      for (int k = 0; k < 3; ++k) {
        const int other = graph_.neighbours[face][k];
        if (other >= 0 && chart_of_face_[other] != chart) common[chart_of_face_[other]] += edge_length(face, k);
      }
    std::vector<int> neighbours;
    for (const auto& [neighbour, ignored] : common) neighbours.push_back(neighbour);
    std::stable_sort(neighbours.begin(), neighbours.end(), [&](int a, int b) { return common[a] > common[b]; });
    neighbours.resize(std::min<std::size_t>(3, neighbours.size()));
    return neighbours;
  }

  bool join(int chart, int neighbour, double max_l2_stretch) {
    std::vector<int> faces = charts_[neighbour].faces;
    faces.insert(faces.end(), charts_[chart].faces.begin(), charts_[chart].faces.end());
    std::sort(faces.begin(), faces.end());
    FlatChart joined = cut_chart(mesh_, graph_, std::move(faces));
    if (!is_disk(joined) || !flatten(joined) || !is_sound(joined, max_l2_stretch)) {
      failed_.insert({chart, neighbour}), failed_.insert({neighbour, chart});
      return false;
    }
    std::erase_if(failed_, [&](const auto& pair) { return pair.first == neighbour || pair.second == neighbour; });
    charts_[neighbour] = std::move(joined);
    charts_[chart] = {};
    label(neighbour);
    return true;
  }

  const TriangleMesh& mesh_;
  const FaceGraph& graph_;
  std::vector<FlatChart>& charts_;
  std::vector<int> chart_of_face_;
  std::set<std::pair<int, int>> failed_;  ///< not sound together, as they are now
};

}  // namespace

void merge_charts(const TriangleMesh& mesh, const FaceGraph& graph, double largest_area, double max_l2_stretch,
                  std::vector<FlatChart>& charts) {
  // On the 20k dragon the fourth pass finds nothing more.
  constexpr int kPasses = 3;
  Merger merger(mesh, graph, charts);
  for (int i = 0; i < kPasses && merger.pass(largest_area, max_l2_stretch); ++i) {
  }
  std::erase_if(charts, [](const FlatChart& chart) { return chart.faces.empty(); });
}

}  // namespace redmap
