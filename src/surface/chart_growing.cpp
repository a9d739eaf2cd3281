// Lloyd's iteration on the surface: flood from the seeds, cheapest face first; fit normal and centre to each chart;
// move each seed to the face that fits best. New seeds go where the error is largest.
#include "surface/chart_growing.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <queue>

namespace redmap {

namespace {

class Grower {
 public:
  Grower(const FaceGraph& graph, int count, double compactness) : graph_(graph), labels_(graph.areas.size(), -1) {
    // Distances count in units of the radius that a chart of average area has.
    const double area = std::accumulate(graph.areas.begin(), graph.areas.end(), 0.0);
    distance_weight_ = compactness * count / std::max(area, std::numeric_limits<double>::min());
  }

  std::vector<int> run(int count, int rounds) {
    add_chart(0);
    grow(), fit();
    while (static_cast<int>(charts_.size()) < count) {
      if (!add_seeds(count)) break;
      grow(), fit();
      grow(), fit();
    }
    for (int i = 0; i < rounds; ++i) grow(), fit();
    grow();
    return std::move(labels_);
  }

 private:
  struct Chart {
    int seed;
    Eigen::Vector3d normal, centre;
  };
  struct Candidate {
    double error;
    int face, chart;
    bool operator<(const Candidate& other) const { return error > other.error; }
  };

  /// Error of one face in a chart for each unit of area.
  double misfit(int face, int chart) const {
    return (graph_.normals[face] - charts_[chart].normal).squaredNorm() +
           distance_weight_ * (graph_.centroids[face] - charts_[chart].centre).squaredNorm();
  }

  void add_chart(int seed) { charts_.push_back({seed, graph_.normals[seed], graph_.centroids[seed]}); }

  void claim(int face, int chart) {
    labels_[face] = chart;
    for (const int next : graph_.neighbours[face])
      if (next >= 0 && labels_[next] < 0) queue_.push({graph_.areas[next] * misfit(next, chart), next, chart});
  }

  void flood() {
    while (!queue_.empty()) {
      const Candidate best = queue_.top();
      queue_.pop();
      if (labels_[best.face] < 0) claim(best.face, best.chart);
    }
  }

  void grow() {
    std::fill(labels_.begin(), labels_.end(), -1);
    for (int chart = 0; chart < static_cast<int>(charts_.size()); ++chart)
      if (labels_[charts_[chart].seed] < 0) claim(charts_[chart].seed, chart);
    flood();
    // Parts of the surface without a seed get one.
    for (int face = 0; face < graph_.size(); ++face)
      if (labels_[face] < 0) {
        add_chart(face);
        claim(face, static_cast<int>(charts_.size()) - 1);
        flood();
      }
  }

  void fit() {
    std::vector<Eigen::Vector3d> normals(charts_.size(), Eigen::Vector3d::Zero()), centres = normals;
    std::vector<double> areas(charts_.size());
    for (int f = 0; f < graph_.size(); ++f) {
      const int chart = labels_[f];
      normals[chart] += graph_.areas[f] * graph_.normals[f];
      centres[chart] += graph_.areas[f] * graph_.centroids[f];
      areas[chart] += graph_.areas[f];
    }
    for (std::size_t chart = 0; chart < charts_.size(); ++chart) {
      if (areas[chart] <= 0) continue;
      charts_[chart].normal = normals[chart].normalized();
      charts_[chart].centre = centres[chart] / areas[chart];
    }
    std::vector<double> least(charts_.size(), std::numeric_limits<double>::infinity());
    for (int f = 0; f < graph_.size(); ++f) {
      const int chart = labels_[f];
      const double error = misfit(f, chart);
      if (error < least[chart]) least[chart] = error, charts_[chart].seed = f;
    }
  }

  /// Up to half as many seeds again, each at the worst face of one of the worst charts. False if none helps.
  bool add_seeds(int count) {
    std::vector<double> total(charts_.size()), worst(charts_.size(), -1);
    std::vector<int> worst_face(charts_.size(), -1), order(charts_.size());
    for (int f = 0; f < graph_.size(); ++f) {
      const int chart = labels_[f];
      const double error = graph_.areas[f] * misfit(f, chart);
      total[chart] += error;
      if (error > worst[chart] && f != charts_[chart].seed) worst[chart] = error, worst_face[chart] = f;
    }
    std::iota(order.begin(), order.end(), 0);
    std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return total[a] > total[b]; });
    const std::size_t before = charts_.size();
    const std::size_t wanted = std::min<std::size_t>(std::max<std::size_t>(1, before / 2), count - before);
    for (std::size_t i = 0; i < before && charts_.size() < before + wanted; ++i)
      if (worst_face[order[i]] >= 0) add_chart(worst_face[order[i]]);
    return charts_.size() > before;
  }

  const FaceGraph& graph_;
  double distance_weight_;
  std::vector<Chart> charts_;
  std::vector<int> labels_;
  std::priority_queue<Candidate> queue_;
};

}  // namespace

std::vector<int> grow_charts(const FaceGraph& graph, int count, double compactness, int rounds) {
  return Grower(graph, count, compactness).run(count, rounds);
}

}  // namespace redmap
