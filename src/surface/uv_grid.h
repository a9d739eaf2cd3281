// Triangles of an atlas binned in a uniform grid over the unit uv square, so that a few texels find theirs at once.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/vec.h"
#include "surface/mesh.h"

namespace redmap {

class UvGrid {
 public:
  /// About one cell a triangle, at most 512 x 512. Triangles without area in uv are left out.
  UvGrid(std::span<const Vec2> uv, std::span<const Triangle> triangles);

  /// Every triangle that may touch the closed rectangle [lower, upper], ascending, each once.
  void find(Vec2 lower, Vec2 upper, std::vector<std::uint32_t>& triangles) const;

 private:
  int column(float coordinate) const;

  int cells_;
  std::vector<std::uint32_t> first_;    // cells_^2 + 1: where each cell's triangles start
  std::vector<std::uint32_t> members_;  // triangle indices, ascending within a cell
};

}  // namespace redmap
