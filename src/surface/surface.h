// A surface that can be textured: analytic sphere and cylinder, or a mesh with an atlas (paper, section 4.1).
// It maps texels to points when a map is baked, and ray hits to points when it is rendered.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/extent.h"
#include "base/surface_points.h"
#include "base/vec.h"

namespace redmap {

struct TriangleMesh;
class Seams;

/// Points found on the surface under some texels: point i lies under texel `texel[i]`, row-major within the region.
/// Ordered by texel, then by sub-point.
struct TexelPoints {
  SurfacePoints points;
  std::vector<std::uint32_t> texel;
};

/// What a ray hit, as the ray tracer knows it. Meshes: triangle index and barycentric weights of its vertices 1 and 2;
/// analytic surfaces: the chart index and the uv that `intersect` returned.
struct HitCoordinates {
  std::uint32_t primitive = 0;
  Vec2 coordinates;
};

/// The surface at a hit, object space. `dp_du`, `dp_dv`: change of position with the map's uv; `dn_du`, `dn_dv`: change
/// of the interpolated unit normal with it. `normal` is the
/// interpolated unit normal, `tangent` a unit vector
/// perpendicular to it, `geometric_normal` the face's, both outward. `chart` tells disconnected parts of the map
/// apart. `rest` is the same place before any deformation, which is where shaders see it.
struct SurfaceHit {
  Vec3 position, normal, geometric_normal, tangent, dp_du, dp_dv, dn_du, dn_dv;
  Vec2 uv;
  std::uint32_t chart = 0;
  struct Rest {
    Vec3 position, normal, tangent;
  } rest;
};

class Surface {
 public:
  virtual ~Surface() = default;

  /// Texels of the base level for maps of size `size`: size x size, and 2 size x size on the sphere.
  virtual Extent map_extent(int size) const = 0;
  /// Whether u = 0 and u = 1 are the same place.
  virtual bool wraps_u() const = 0;
  /// Area in object space, and the part of the unit uv square that is covered (0 to 1).
  virtual double area() const = 0;
  virtual double uv_area() const = 0;

  /// Points under the texels of `region` of a map of `extent` texels. For every texel t with `wanted[t] != 0`
  /// (row-major within the region; empty means all) and every offset (in texels from the texel's corner, [0, 1)), one
  /// point if the surface is there, none otherwise. Where two triangles claim a place the one with the smaller index
  /// has it.
  virtual void rasterize(Extent extent, TexelRegion region, std::span<const Vec2> offsets,
                         std::span<const std::uint8_t> wanted, TexelPoints& out) const = 0;

  /// Everything about the surface at ray hits. `out` has the size of `hits`.
  virtual void complete(std::span<const HitCoordinates> hits, std::span<SurfaceHit> out) const = 0;
  /// SurfaceHit::chart of a hit, without the rest.
  virtual std::uint32_t chart(std::uint32_t primitive) const { return primitive; }

  /// Analytic surfaces: first hit with t in (t_near, t_far) of a ray in object space (`direction` need not be unit).
  /// Meshes answer nullopt always: their triangles are for the ray tracer.
  struct AnalyticHit {
    float t;
    HitCoordinates where;
    Vec3 geometric_normal;
  };
  virtual std::optional<AnalyticHit> intersect(Vec3 origin, Vec3 direction, float t_near, float t_far) const = 0;
  virtual const TriangleMesh* mesh() const { return nullptr; }
  /// Meshes: the same triangles before any deformation.
  virtual const TriangleMesh* mesh_at_rest() const { return mesh(); }
  /// Meshes: where their charts end, and how the surface goes on.
  virtual const Seams* seams() const { return nullptr; }

  /// Object-space bounds.
  virtual Vec3 lower() const = 0;
  virtual Vec3 upper() const = 0;

  /// A hash of everything that decides where texels lie on the surface at rest: maps remember it.
  virtual std::uint64_t fingerprint() const = 0;
  /// The same with the pose of a deformed mesh: what decides the picture. Differs from fingerprint() only there.
  virtual std::uint64_t pose_fingerprint() const { return fingerprint(); }
};

/// Unit sphere: u = azimuth / 2 pi about +y from +x towards +z, v = polar angle / pi from +y. Radius in object units.
std::shared_ptr<const Surface> make_sphere(float radius);
/// Open cylinder about the y axis, y in [-height/2, height/2]: u = azimuth / 2 pi, v from bottom to top.
std::shared_ptr<const Surface> make_cylinder(float radius, float height);

}  // namespace redmap
