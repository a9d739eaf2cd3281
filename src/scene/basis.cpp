#include "scene/basis.h"

#include <algorithm>

namespace redmap {

std::unique_ptr<BoundPatterns> bind_basis(const Shader& shader, const ReductionMap& map) {
  SurfacePoints points;
  points.resize(map.basis.size());
  // Padding repeats the last place: shaders evaluate it too.
  for (std::size_t i = 0; i < points.position.stride(); ++i) {
    const BasisPlace& place = map.basis[std::min(i, map.basis.size() - 1)];
    points.position.set(i, place.position);
    points.normal.set(i, place.normal);
    points.tangent.set(i, place.tangent);
    points.uv.set(i, place.uv);
  }
  return shader.bind(points);
}

}  // namespace redmap
