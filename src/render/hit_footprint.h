// From a ray that hit a surface to the footprint of its sample in the map (Igehy 1999; Heckbert 1989).
#pragma once

#include <algorithm>
#include <cmath>

#include "map/footprint.h"
#include "map/lookup_limits.h"
#include "scene/camera_rays.h"
#include "surface/surface.h"

namespace redmap {

/// Change of uv under a change of position in the tangent plane: least squares on dp_du, dp_dv.
inline Vec2 uv_change(const SurfaceHit& hit, Vec3 dp) {
  const float uu = dot(hit.dp_du, hit.dp_du), uv = dot(hit.dp_du, hit.dp_dv), vv = dot(hit.dp_dv, hit.dp_dv);
  const float determinant = std::max(uu * vv - uv * uv, 1e-30f);  // nil only where the map is degenerate
  const float pu = dot(dp, hit.dp_du), pv = dot(dp, hit.dp_dv);
  return {(vv * pu - uv * pv) / determinant, (uu * pv - uv * pu) / determinant};
}

/// Footprint of a camera sample. `direction` (unit) and `per_pixel` in object space, `distance` from the camera in
/// object units, `extent` the sample's side in pixels.
inline Footprint camera_footprint(const SurfaceHit& hit, Vec3 direction, const DirectionDifferential& per_pixel,
                                  float distance, float extent) {
  const float facing = dot(direction, hit.geometric_normal);
  const float cosine = std::copysign(std::max(std::abs(facing), kLeastCosine), facing);
  const auto project = [&](Vec3 change) {
    const Vec3 dp = change * (distance * extent);
    return uv_change(hit, dp - direction * (dot(dp, hit.geometric_normal) / cosine));
  };
  return {hit.uv, project(per_pixel.dx), project(per_pixel.dy)};
}

/// Footprint of a disc-like `width` (object units) on the surface: for shadow rays, whose footprint is that of the
/// sample they light.
inline Footprint round_footprint(const SurfaceHit& hit, float width) {
  const Frame frame = make_frame(hit.geometric_normal, hit.dp_du);
  return {hit.uv, uv_change(hit, frame.x * width), uv_change(hit, frame.y * width)};
}

}  // namespace redmap
