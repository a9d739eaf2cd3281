#include "render/joined_hits.h"

#include <array>
#include <cmath>
#include <optional>

namespace redmap {

namespace {

/// Farther off the tangent plane of the first hit, as a part of their distance, another is on another piece: over a
/// seam, behind a fold, or beyond the pole of a sphere.
constexpr float kLargestFold = 0.5f;
/// Squared distance of two normals from which one Gaussian no longer says how they turn.
constexpr float kLargestBend = 0.25f;

/// Reading order, in one pixel, at most `largest` wide.
bool is_square(std::span<const CameraSample> samples, std::span<const std::uint32_t, kJoined> of, float largest) {
  const CameraSample& first = samples[of[0]];
  const float step = first.extent;
  if (2 * step > largest) return false;
  const auto at = [&](int k, float x, float y) {
    const CameraSample& s = samples[of[k]];
    return s.pixel == first.pixel && std::abs(s.x - first.x - x) < 0.25f * step &&
           std::abs(s.y - first.y - y) < 0.25f * step;
  };
  return at(1, step, 0) && at(2, 0, step) && at(3, step, step);
}

template <typename T>
T mean(const T& a, const T& b, const T& c, const T& d) {
  return (a + b + c + d) * (1.0f / kJoined);
}

/// How something changes across a square, given its four corners less the first.
template <typename T>
struct Change {
  T dx, dy;
  explicit Change(const std::array<T, kJoined>& from_first)
      : dx(from_first[1] + (from_first[3] - from_first[2])), dy(from_first[2] + (from_first[3] - from_first[1])) {}
};

/// Four hits as one, and its footprint.
struct Joined {
  SurfaceHit hit;
  Footprint footprint;
  std::array<Vec2, kJoined> parts;
};
std::optional<Joined> join(std::span<const SurfaceHit, kJoined> h, bool wraps_u) {
  std::array<Vec2, kJoined> uv;
  std::array<Vec3, kJoined> position, normal;
  for (std::size_t k = 1; k < kJoined; ++k) {
    uv[k] = h[k].uv - h[0].uv, position[k] = h[k].position - h[0].position, normal[k] = h[k].normal - h[0].normal;
    if (wraps_u) uv[k].x -= std::round(uv[k].x);
    const Vec3 off = h[0].dp_du * uv[k].x + h[0].dp_dv * uv[k].y - position[k];
    if (h[k].chart != h[0].chart || dot(normal[k], normal[k]) > kLargestBend ||
        dot(off, off) > kLargestFold * kLargestFold * dot(position[k], position[k]))
      return std::nullopt;
  }
  const Change<Vec2> across_uv(uv);
  const Vec2 x = across_uv.dx, y = across_uv.dy;
  const float determinant = cross(x, y);
  if (!std::isnormal(determinant)) return std::nullopt;
  const float inverse = 1 / determinant;
  const auto by_u = [&](const Change<Vec3>& change) { return (change.dx * y.y - change.dy * x.y) * inverse; };
  const auto by_v = [&](const Change<Vec3>& change) { return (change.dy * x.x - change.dx * y.x) * inverse; };
  const auto mean_of = [&](auto SurfaceHit::*member) {
    return mean(h[0].*member, h[1].*member, h[2].*member, h[3].*member);
  };
  const auto mean_at_rest = [&](auto SurfaceHit::Rest::*member) {
    return mean(h[0].rest.*member, h[1].rest.*member, h[2].rest.*member, h[3].rest.*member);
  };

  Joined joined;
  SurfaceHit& hit = joined.hit;
  const Change<Vec3> moved(position), turned(normal);
  hit.position = mean_of(&SurfaceHit::position);
  hit.geometric_normal = normalized(mean_of(&SurfaceHit::geometric_normal));
  hit.dp_du = by_u(moved), hit.dp_dv = by_v(moved), hit.dn_du = by_u(turned), hit.dn_dv = by_v(turned);
  const Frame frame = make_frame(normalized(mean_of(&SurfaceHit::normal)), mean_of(&SurfaceHit::tangent));
  hit.normal = frame.z, hit.tangent = frame.x;
  hit.uv = h[0].uv + mean(uv[0], uv[1], uv[2], uv[3]);
  hit.chart = h[0].chart;
  const Frame rest =
      make_frame(normalized(mean_at_rest(&SurfaceHit::Rest::normal)), mean_at_rest(&SurfaceHit::Rest::tangent));
  hit.rest = {mean_at_rest(&SurfaceHit::Rest::position), rest.z, rest.x};
  joined.footprint = {hit.uv, x, y};
  for (std::size_t k = 0; k < kJoined; ++k) joined.parts[k] = h[0].uv + uv[k];
  return joined;
}

Vec3 mean_direction(const std::vector<Vec3>& directions, std::size_t first) {
  return normalized(mean(directions[first], directions[first + 1], directions[first + 2], directions[first + 3]));
}

void add_joined(const ShadingBatch& from, std::uint32_t first, const Joined& joined, ShadingBatch& to) {
  to.hits.push_back(joined.hit);
  to.turned.push_back(from.turned[first]);
  to.frames.push_back({joined.hit.tangent, cross(joined.hit.normal, joined.hit.tangent), joined.hit.normal});
  to.footprints.push_back(joined.footprint);
  to.parts.push_back(joined.parts);
  to.to_viewer.push_back(mean_direction(from.to_viewer, first));
}

void join_lights(const ShadingBatch& from, std::span<const std::uint32_t> first, ShadingBatch& to) {
  to.lights.resize(from.lights.size());
  for (std::size_t l = 0; l < from.lights.size(); ++l) {
    const ShadingBatch::Light& light = from.lights[l];
    to.lights[l].to_light.resize(first.size());
    to.lights[l].irradiance = Planes<3>(first.size());
    for (std::size_t i = 0; i < first.size(); ++i) {
      const std::uint32_t k = first[i];
      const auto arriving = [&](std::uint32_t corner) { return light.irradiance.get(k + corner); };
      to.lights[l].to_light[i] = mean_direction(light.to_light, k);
      to.lights[l].irradiance.set(i, mean(arriving(0), arriving(1), arriving(2), arriving(3)));
    }
  }
}

}  // namespace

void take_apart(const ObjectShading& shading, std::span<const Decision> decisions, JoinedHits& joined) {
  for (std::size_t i = 0; i < decisions.size(); ++i) {
    if (!shading.takes_apart(decisions[i])) continue;
    for (std::uint32_t corner = 0; corner < kJoined; ++corner) joined.single.push_back(joined.first[i] + corner);
    joined.first[i] = kTakenApart;
  }
}

JoinedHits join_hits(std::span<const CameraSample> samples, std::span<const std::uint32_t> sample_of,
                     const ShadingBatch& batch, float largest, const ObjectShading& shading, bool wraps_u) {
  JoinedHits result;
  result.batch.time = batch.time;
  for (std::uint32_t i = 0; i < batch.size();) {
    std::optional<Joined> joined;
    const bool same_side = i + kJoined <= batch.size() && batch.turned[i] == batch.turned[i + 1] &&
                           batch.turned[i] == batch.turned[i + 2] && batch.turned[i] == batch.turned[i + 3];
    if (same_side && is_square(samples, sample_of.subspan(i).first<kJoined>(), largest))
      joined = join(std::span(batch.hits).subspan(i).first<kJoined>(), wraps_u);
    if (joined && shading.takes_joined(joined->footprint)) {
      add_joined(batch, i, *joined, result.batch);
      result.first.push_back(i), i += kJoined;
    } else {
      result.single.push_back(i), ++i;
    }
  }
  join_lights(batch, result.first, result.batch);
  return result;
}

}  // namespace redmap
