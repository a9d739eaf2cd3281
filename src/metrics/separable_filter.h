// Filters that are a row times a column.
#pragma once

#include <cstddef>
#include <vector>

namespace redmap {

/// `width` x `height` floats, row by row.
struct Plane {
  int width = 0, height = 0;
  std::vector<float> data;

  Plane(int columns, int rows)
      : width(columns), height(rows), data(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows)) {}
  float& at(int x, int y) { return data[static_cast<std::size_t>(y) * width + x]; }
  float at(int x, int y) const { return data[static_cast<std::size_t>(y) * width + x]; }
};

/// Weights of the pixels at offsets -radius to radius.
using Kernel = std::vector<float>;

/// Correlates `plane` with `across` along x and then with `down` along y; outside, the border pixels go on.
Plane filter_separable(const Plane& plane, const Kernel& across, const Kernel& down);

}  // namespace redmap
