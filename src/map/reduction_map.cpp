#include "map/reduction_map.h"

#include <algorithm>

namespace redmap {

SurfacePoints basis_points(const ReductionMap& map) {
  SurfacePoints points;
  points.resize(map.basis.size());
  // Shaders evaluate the padding too.
  for (std::size_t i = 0; i < points.position.stride(); ++i) {
    const BasisPlace& place = map.basis[std::min(i, map.basis.size() - 1)];
    points.position.set(i, place.position);
    points.normal.set(i, place.normal);
    points.tangent.set(i, place.tangent);
    points.uv.set(i, place.uv);
  }
  return points;
}

}  // namespace redmap
