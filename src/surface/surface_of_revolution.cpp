// Texels and hits on a turned profile. Sines are computed once a column and once a row of a region.
#include "surface/surface_of_revolution.h"

#include <cmath>
#include <numbers>

namespace redmap {

namespace {

constexpr double kTwoPi = 2 * std::numbers::pi;

struct Azimuth {
  double cos, sin;
};

Azimuth azimuth(double u) { return {std::cos(kTwoPi * u), std::sin(kTwoPi * u)}; }

Vec3 turned(double out, double y, const Azimuth& at) {
  return {static_cast<float>(out * at.cos), static_cast<float>(y), static_cast<float>(out * at.sin)};
}

Vec3 tangent(const Azimuth& at) { return {static_cast<float>(-at.sin), 0, static_cast<float>(at.cos)}; }

}  // namespace

float azimuth_u(double x, double z) {
  const double turns = std::atan2(z, x) / kTwoPi;
  const float u = static_cast<float>(turns < 0 ? turns + 1 : turns);
  return u < 1 ? u : 0;
}

void SurfaceOfRevolution::rasterize(Extent extent, TexelRegion region, std::span<const Vec2> offsets,
                                    std::span<const std::uint8_t> wanted, TexelPoints& out) const {
  const std::size_t count = offsets.size(), width = region.width, height = region.height;
  const auto texel_u = [&](std::size_t x, std::size_t k) {
    return (region.x + double(x) + offsets[k].x) / extent.width;
  };
  const auto texel_v = [&](std::size_t y, std::size_t k) {
    return (region.y + double(y) + offsets[k].y) / extent.height;
  };
  std::vector<Azimuth> columns(width * count);
  for (std::size_t i = 0; i < columns.size(); ++i) columns[i] = azimuth(texel_u(i / count, i % count));

  // Every wanted texel has all its points: the surface covers the whole map.
  out.texel.clear();
  for (std::size_t texel = 0; texel < width * height; ++texel)
    if (wanted.empty() || wanted[texel]) out.texel.insert(out.texel.end(), count, static_cast<std::uint32_t>(texel));
  out.points.resize(out.texel.size());

  std::size_t point = 0;
  std::vector<ProfilePoint> row(count);
  for (std::size_t y = 0; y < height; ++y) {
    for (std::size_t k = 0; k < count; ++k) row[k] = profile(texel_v(y, k));
    for (; point < out.texel.size() && out.texel[point] < (y + 1) * width; ++point) {
      const std::size_t x = out.texel[point] - y * width, k = point % count;
      const Azimuth& at = columns[x * count + k];
      out.points.position.set(point, turned(row[k].radius, row[k].y, at));
      out.points.normal.set(point, turned(row[k].normal_out, row[k].normal_y, at));
      out.points.tangent.set(point, tangent(at));
      out.points.uv.set(point, Vec2{static_cast<float>(texel_u(x, k)), static_cast<float>(texel_v(y, k))});
    }
  }
}

void SurfaceOfRevolution::complete(std::span<const HitCoordinates> hits, std::span<SurfaceHit> out) const {
  for (std::size_t i = 0; i < hits.size(); ++i) {
    const Vec2 uv = hits[i].coordinates;
    const Azimuth at = azimuth(uv.x);
    const ProfilePoint p = profile(uv.y);
    const Vec3 normal = turned(p.normal_out, p.normal_y, at);
    const Vec3 position = turned(p.radius, p.y, at);
    out[i] = {.position = position,
              .normal = normal,
              .geometric_normal = normal,
              .tangent = tangent(at),
              .dp_du = tangent(at) * static_cast<float>(kTwoPi * p.radius),
              .dp_dv = turned(p.radius_dv, p.y_dv, at),
              .dn_du = tangent(at) * static_cast<float>(kTwoPi * p.normal_out),
              .dn_dv = turned(p.normal_out_dv, p.normal_y_dv, at),
              .uv = uv,
              .chart = hits[i].primitive,
              .rest = {position, normal, tangent(at)}};
  }
}

}  // namespace redmap
