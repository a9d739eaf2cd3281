// The cells of the atlas that a chart needs at some scale, in every direction it may be turned to.
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "surface/cell_bitmap.h"
#include "surface/flat_chart.h"

namespace redmap {

/// The grid charts are packed into: `cells` x `cells` squares of `cell_texels`, and how near, in texels, a chart may
/// come to another's cell.
struct PackingGrid {
  int cells;
  double cell_texels, gutter_texels;
};

/// A chart turned by `angle` and scaled, as cells: everything within the gutter of it. Empty where it would not fit
/// the grid.
struct ChartShape {
  double angle = 0;
  Eigen::Vector2d origin = Eigen::Vector2d::Zero();  ///< where the plane's origin lands, texels from the first cell
  CellBitmap cells;
  std::vector<Cell> samples;  ///< some of the cells, spread over the shape
  double centre_row = 0;      ///< mean row of the cells
  bool empty() const { return samples.empty(); }
};

/// The outline of a chart: pairs of ends of its boundary edges in `plane`.
using Outline = std::vector<std::array<Eigen::Vector2d, 2>>;
Outline outline_of(const FlatChart& chart);

ChartShape make_shape(const Outline& outline, double angle, double scale, const PackingGrid& grid);

}  // namespace redmap
