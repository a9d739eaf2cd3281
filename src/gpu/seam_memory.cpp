// Edges binned by the cells that their bounding rectangles touch, as surface/uv_grid.cpp bins triangles.
#include "gpu/seam_memory.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "surface/mesh.h"
#include "surface/seams.h"

namespace redmap {
namespace {

using Words = std::vector<std::uint32_t>;

/// Edges by the cells of a grid of n x n over the unit square.
class EdgeGrid {
 public:
  explicit EdgeGrid(std::span<const SeamEdge> edges)
      : cells_(std::clamp(static_cast<int>(std::sqrt(double(edges.size()))), 1, kMostCells)),
        lists_(static_cast<std::size_t>(cells_) * cells_) {
    for (std::uint32_t i = 0; i < edges.size(); ++i) add(edges[i], i);
  }

  void append_starts(Words& words) const {
    words.push_back(static_cast<std::uint32_t>(cells_));
    std::uint32_t start = 0;
    words.push_back(start);
    for (const Words& list : lists_) words.push_back(start += static_cast<std::uint32_t>(list.size()));
  }
  void append_lists(Words& words) const {
    for (const Words& list : lists_) words.insert(words.end(), list.begin(), list.end());
  }

 private:
  static constexpr int kMostCells = 512;  // a side, as UvGrid's

  int column(float coordinate) const {
    return std::clamp(static_cast<int>(coordinate * static_cast<float>(cells_)), 0, cells_ - 1);
  }
  void add(const SeamEdge& edge, std::uint32_t number) {
    const auto [left, right] = std::minmax(edge.from.x, edge.to.x);
    const auto [bottom, top] = std::minmax(edge.from.y, edge.to.y);
    for (int y = column(bottom); y <= column(top); ++y)
      for (int x = column(left); x <= column(right); ++x)
        lists_[static_cast<std::size_t>(y) * cells_ + x].push_back(number);
  }

  int cells_;
  std::vector<Words> lists_;
};

void append_edge(const SeamEdge& edge, Words& words) {
  for (const Vec2 v : {edge.from, edge.to, edge.outward, edge.from_beyond, edge.along_u, edge.along_v})
    words.push_back(std::bit_cast<std::uint32_t>(v.x)), words.push_back(std::bit_cast<std::uint32_t>(v.y));
  words.push_back(edge.chart);
}

}  // namespace

std::vector<std::uint32_t> seam_data(const Surface& surface) {
  const std::span<const SeamEdge> edges = surface.seams()->edges();
  const EdgeGrid grid(edges);
  Words words;
  grid.append_starts(words);
  words.push_back(static_cast<std::uint32_t>(edges.size()));
  for (const SeamEdge& edge : edges) append_edge(edge, words);
  grid.append_lists(words);
  const auto triangles = static_cast<std::uint32_t>(surface.mesh()->triangles.size());
  for (std::uint32_t t = 0; t < triangles; ++t) words.push_back(surface.chart(t));
  return words;
}

}  // namespace redmap
