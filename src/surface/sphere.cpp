// The analytic sphere: the paper's own first test surface (section 4.1 with an atlas known in closed form).
#include <bit>
#include <cmath>
#include <numbers>

#include "base/error.h"
#include "base/random.h"
#include "surface/surface_of_revolution.h"

namespace redmap {

namespace {

constexpr double kPiDouble = std::numbers::pi;

class Sphere final : public SurfaceOfRevolution {
 public:
  explicit Sphere(float radius) : radius_(radius) {}

  Extent map_extent(int size) const override { return {2 * size, size}; }
  double area() const override { return 4 * kPiDouble * radius_ * radius_; }
  Vec3 lower() const override { return {-radius_, -radius_, -radius_}; }
  Vec3 upper() const override { return {radius_, radius_, radius_}; }
  std::uint64_t fingerprint() const override { return hash64(0x737068657265, std::bit_cast<std::uint32_t>(radius_)); }

  std::optional<AnalyticHit> intersect(Vec3 origin, Vec3 direction, float t_near, float t_far) const override {
    const double ox = origin.x, oy = origin.y, oz = origin.z, dx = direction.x, dy = direction.y, dz = direction.z;
    const double dd = dx * dx + dy * dy + dz * dz;
    // Work from the ray's point closest to the centre: it is small however far away the origin is, so nothing cancels.
    const double t_closest = -(ox * dx + oy * dy + oz * dz) / dd;
    const double cx = ox + t_closest * dx, cy = oy + t_closest * dy, cz = oz + t_closest * dz;
    const double inside = double(radius_) * radius_ - (cx * cx + cy * cy + cz * cz);
    if (!(inside >= 0)) return std::nullopt;
    const double half_chord = std::sqrt(inside / dd);
    for (const double step : {-half_chord, half_chord}) {
      const double t = t_closest + step;
      if (t <= t_near || t >= t_far) continue;
      const double x = cx + step * dx, y = cy + step * dy, z = cz + step * dz;
      const float v = static_cast<float>(std::atan2(std::hypot(x, z), y) / kPiDouble);
      const Vec3 normal{static_cast<float>(x / radius_), static_cast<float>(y / radius_),
                        static_cast<float>(z / radius_)};
      return AnalyticHit{static_cast<float>(t), {0, {azimuth_u(x, z), v}}, normal};
    }
    return std::nullopt;
  }

 protected:
  ProfilePoint profile(double v) const override {
    const double cos = std::cos(kPiDouble * v), sin = std::sin(kPiDouble * v);
    return {radius_ * sin,   radius_ * cos,   sin, cos, kPiDouble * radius_ * cos, -kPiDouble * radius_ * sin,
            kPiDouble * cos, -kPiDouble * sin};
  }

 private:
  float radius_;
};

}  // namespace

std::shared_ptr<const Surface> make_sphere(float radius) {
  if (!(radius > 0) || !std::isfinite(radius))
    throw Error("sphere: radius must be positive and finite, found {}", radius);
  return std::make_shared<Sphere>(radius);
}

}  // namespace redmap
