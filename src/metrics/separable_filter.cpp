// Filters that are a row times a column.
#include "metrics/separable_filter.h"

#include <algorithm>

#include "base/parallel.h"

namespace redmap {

namespace {

int radius_of(const Kernel& kernel) { return static_cast<int>(kernel.size() / 2); }

Plane filter_rows(const Plane& plane, const Kernel& kernel) {
  const int radius = radius_of(kernel);
  Plane result(plane.width, plane.height);
  parallel_for(static_cast<std::size_t>(plane.height), [&](std::size_t row) {
    const int y = static_cast<int>(row);
    // The row with its ends repeated, so that the inner loop has no borders.
    std::vector<float> wide(static_cast<std::size_t>(plane.width + 2 * radius));
    for (int x = -radius; x < plane.width + radius; ++x)
      wide[x + radius] = plane.at(std::clamp(x, 0, plane.width - 1), y);
    float* out = &result.at(0, y);
    for (std::size_t k = 0; k < kernel.size(); ++k)
      for (int x = 0; x < plane.width; ++x) out[x] += kernel[k] * wide[x + k];
  });
  return result;
}

Plane filter_columns(const Plane& plane, const Kernel& kernel) {
  const int radius = radius_of(kernel);
  Plane result(plane.width, plane.height);
  parallel_for(static_cast<std::size_t>(plane.height), [&](std::size_t row) {
    const int y = static_cast<int>(row);
    float* out = &result.at(0, y);
    for (int k = -radius; k <= radius; ++k) {
      const int source_y = std::clamp(y + k, 0, plane.height - 1);
      const float* in = plane.data.data() + static_cast<std::size_t>(source_y) * plane.width;
      for (int x = 0; x < plane.width; ++x) out[x] += kernel[k + radius] * in[x];
    }
  });
  return result;
}

}  // namespace

Plane filter_separable(const Plane& plane, const Kernel& across, const Kernel& down) {
  return filter_columns(filter_rows(plane, across), down);
}

}  // namespace redmap
