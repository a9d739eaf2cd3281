// What the sphere and the cylinder share: a profile turned about the y axis, u = azimuth / 2 pi.
#pragma once

#include "surface/surface.h"

namespace redmap {

/// The profile at one v: distance from the axis, height, the outward unit normal's part away from the axis and along
/// it, and how all four change with v.
struct ProfilePoint {
  double radius, y, normal_out, normal_y;
  double radius_dv, y_dv, normal_out_dv, normal_y_dv;
};

/// A profile turned about +y, from +x towards +z. Its normal is the profile's, its tangent always points along the
/// azimuth, also at poles, where dp_du vanishes.
class SurfaceOfRevolution : public Surface {
 public:
  bool wraps_u() const override { return true; }
  double uv_area() const override { return 1; }
  void rasterize(Extent extent, TexelRegion region, std::span<const Vec2> offsets, std::span<const std::uint8_t> wanted,
                 TexelPoints& out) const override;
  void complete(std::span<const HitCoordinates> hits, std::span<SurfaceHit> out) const override;

 protected:
  /// The profile at v in [0, 1].
  virtual ProfilePoint profile(double v) const = 0;
};

/// u in [0, 1) of a place at (x, z); 0 on the axis.
float azimuth_u(double x, double z);

}  // namespace redmap
