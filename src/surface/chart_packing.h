// Placing flattened charts in the unit square, as bitmaps of cells that no two charts share.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "surface/flat_chart.h"

namespace redmap {

/// Where a chart goes: turned by `angle` (radians) about the origin of its plane, scaled by the common scale, moved by
/// `offset` texels.
struct Placement {
  double angle = 0;
  Eigen::Vector2d offset = Eigen::Vector2d::Zero();
};

struct Packing {
  double scale = 0;  ///< texels for each unit of length
  std::vector<Placement> placements;
};

/// The largest common scale found at which all charts fit `resolution` x `resolution` texels, cut into cells of
/// `cell_texels`: every cell within `gutter_texels` of a chart is that chart's own. Nothing if even the smallest scale
/// does not fit.
std::optional<Packing> pack_charts(std::span<const FlatChart> charts, int resolution, int cell_texels,
                                   int gutter_texels);

/// A point of a chart's plane in texels of the map.
Eigen::Vector2d place(const Placement& placement, double scale, const Eigen::Vector2d& point);

}  // namespace redmap
