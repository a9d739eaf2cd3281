// The analytic open cylinder: a developable surface, on which the map neither stretches nor shears.
#include <bit>
#include <cmath>
#include <numbers>

#include "base/error.h"
#include "base/random.h"
#include "surface/surface_of_revolution.h"

namespace redmap {

namespace {

class Cylinder final : public SurfaceOfRevolution {
 public:
  Cylinder(float radius, float height) : radius_(radius), height_(height) {}

  Extent map_extent(int size) const override { return {size, size}; }
  double area() const override { return 2 * std::numbers::pi * radius_ * height_; }
  Vec3 lower() const override { return {-radius_, -height_ / 2, -radius_}; }
  Vec3 upper() const override { return {radius_, height_ / 2, radius_}; }
  std::uint64_t fingerprint() const override {
    return hash64(0x63796c696e646572, std::bit_cast<std::uint32_t>(radius_), std::bit_cast<std::uint32_t>(height_));
  }

  std::optional<AnalyticHit> intersect(Vec3 origin, Vec3 direction, float t_near, float t_far) const override {
    const double ox = origin.x, oz = origin.z, dx = direction.x, dz = direction.z;
    const double dd = dx * dx + dz * dz;
    if (dd == 0) return std::nullopt;  // along the axis: never through an open side
    // As on the sphere, from the ray's point closest to the axis.
    const double t_closest = -(ox * dx + oz * dz) / dd;
    const double cx = ox + t_closest * dx, cz = oz + t_closest * dz;
    const double inside = double(radius_) * radius_ - (cx * cx + cz * cz);
    if (!(inside >= 0)) return std::nullopt;
    const double half_chord = std::sqrt(inside / dd);
    for (const double step : {-half_chord, half_chord}) {
      const double t = t_closest + step;
      const double y = origin.y + t * direction.y, v = y / height_ + 0.5;
      if (t <= t_near || t >= t_far || v < 0 || v > 1) continue;
      const double x = cx + step * dx, z = cz + step * dz;
      const Vec3 normal{static_cast<float>(x / radius_), 0, static_cast<float>(z / radius_)};
      return AnalyticHit{static_cast<float>(t), {0, {azimuth_u(x, z), static_cast<float>(v)}}, normal};
    }
    return std::nullopt;
  }

 protected:
  ProfilePoint profile(double v) const override { return {radius_, height_ * (v - 0.5), 1, 0, 0, height_, 0, 0}; }

 private:
  float radius_, height_;
};

}  // namespace

std::shared_ptr<const Surface> make_cylinder(float radius, float height) {
  if (!(radius > 0) || !(height > 0) || !std::isfinite(radius) || !std::isfinite(height))
    throw Error("cylinder: radius and height must be positive and finite, found {} and {}", radius, height);
  return std::make_shared<Cylinder>(radius, height);
}

}  // namespace redmap
