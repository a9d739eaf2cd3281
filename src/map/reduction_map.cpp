#include "map/reduction_map.h"

namespace redmap {

SurfacePoints basis_points(const ReductionMap& map) { return points_at(map.basis); }

std::vector<Frame> basis_frames(const ReductionMap& map) {
  std::vector<Frame> frames;
  if (!map.hides_frames) return frames;
  for (const BasisPlace& place : map.basis) frames.push_back(make_frame(place.frame_z, place.frame_x));
  return frames;
}

}  // namespace redmap
