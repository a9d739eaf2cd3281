// Counting sort of triangles into the cells their bounding rectangles touch.
#include "surface/uv_grid.h"

#include <algorithm>
#include <cmath>

namespace redmap {

namespace {

struct Bounds {
  Vec2 lower, upper;
};

Bounds bounds(Vec2 a, Vec2 b, Vec2 c) {
  return {{std::min({a.x, b.x, c.x}), std::min({a.y, b.y, c.y})},
          {std::max({a.x, b.x, c.x}), std::max({a.y, b.y, c.y})}};
}

}  // namespace

int UvGrid::column(float coordinate) const {
  return std::clamp(static_cast<int>(coordinate * static_cast<float>(cells_)), 0, cells_ - 1);
}

UvGrid::UvGrid(std::span<const Vec2> uv, std::span<const Triangle> triangles)
    : cells_(std::clamp(static_cast<int>(std::sqrt(double(triangles.size()))), 1, 512)) {
  const auto for_each_cell = [&](const auto& visit) {
    for (std::uint32_t t = 0; t < triangles.size(); ++t) {
      const Vec2 a = uv[triangles[t][0]], b = uv[triangles[t][1]], c = uv[triangles[t][2]];
      if (cross(b - a, c - a) == 0) continue;
      const auto [lower, upper] = bounds(a, b, c);
      for (int y = column(lower.y); y <= column(upper.y); ++y)
        for (int x = column(lower.x); x <= column(upper.x); ++x) visit(std::size_t(y) * cells_ + x, t);
    }
  };
  first_.assign(std::size_t(cells_) * cells_ + 1, 0);
  for_each_cell([&](std::size_t cell, std::uint32_t) { ++first_[cell + 1]; });
  for (std::size_t cell = 1; cell < first_.size(); ++cell) first_[cell] += first_[cell - 1];
  members_.resize(first_.back());
  std::vector<std::uint32_t> next(first_.begin(), first_.end() - 1);
  for_each_cell([&](std::size_t cell, std::uint32_t t) { members_[next[cell]++] = t; });
}

void UvGrid::find(Vec2 lower, Vec2 upper, std::vector<std::uint32_t>& triangles) const {
  triangles.clear();
  for (int y = column(lower.y); y <= column(upper.y); ++y) {
    const std::size_t row = std::size_t(y) * cells_;
    triangles.insert(triangles.end(), members_.begin() + first_[row + column(lower.x)],
                     members_.begin() + first_[row + column(upper.x) + 1]);
  }
  std::sort(triangles.begin(), triangles.end());
  triangles.erase(std::unique(triangles.begin(), triangles.end()), triangles.end());
}

}  // namespace redmap
