#include "surface/map_size.h"

#include <cmath>

#include "base/error.h"

namespace redmap {

int map_size_of_at_least(double texels) {
  int size = kSmallestMapSize;
  while (size < kLargestMapSize && size < texels) size *= 2;
  return size;
}

int map_size_for_density(double area, double uv_area, double texels_per_unit) {
  if (!(texels_per_unit > 0) || !std::isfinite(texels_per_unit))
    throw Error("map size: expected texels_per_unit to be a number above 0, found {}", texels_per_unit);
  if (!(area > 0) || !(uv_area > 0))
    throw Error("map size: expected a surface and a map of it that have area, found {} and {}", area, uv_area);
  return map_size_of_at_least(texels_per_unit * std::sqrt(area / uv_area));
}

int map_size_for_density(const Surface& surface, double texels_per_unit) {
  const Extent extent = surface.map_extent(kLargestMapSize);
  const double squares = double(extent.width) * extent.height / (double(kLargestMapSize) * kLargestMapSize);
  return map_size_for_density(surface.area(), surface.uv_area() * squares, texels_per_unit);
}

}  // namespace redmap
