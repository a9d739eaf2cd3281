// Polygons to triangles.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "base/vec.h"

namespace redmap {

/// Triangles, as corner numbers, of the polygon with these corners: n - 2 of them, in its winding. Quadrilaterals are
/// cut along the shorter diagonal that lies inside, larger polygons by clipping ears in their mean plane. A polygon
/// that crosses itself still gets n - 2 triangles. `triangles` is overwritten.
void triangulate(std::span<const Vec3> corners, std::vector<std::array<int, 3>>& triangles);

}  // namespace redmap
