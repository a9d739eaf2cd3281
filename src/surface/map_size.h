// How many texels across a map has to be for a density asked for.
#pragma once

#include "surface/surface.h"

namespace redmap {

/// Sizes that are chosen: powers of two from 16, where a map still has some levels, to the largest that can be baked.
inline constexpr int kSmallestMapSize = 16, kLargestMapSize = 16384;

/// The smallest such size of at least `texels`.
int map_size_of_at_least(double texels);

/// The smallest such size at which `area` of a surface, on the part `uv_area` of a square map, has that many texels
/// along a unit of length, on average. Throws Error unless all are above 0.
int map_size_for_density(double area, double uv_area, double texels_per_unit);
/// The same for a surface, whatever the shape of its map.
int map_size_for_density(const Surface& surface, double texels_per_unit);

}  // namespace redmap
