#include "lobes/lobe_lanes.h"

#include <algorithm>
#include <cmath>

#include "base/lanes_math.h"

namespace redmap {
namespace {

using lanes::Bool;
using lanes::Float;

/// A highlight is as narrow as the Gaussians that make up this part of its peak.
constexpr float kNarrowPart = 0.25f;
constexpr float kDegrees = 57.2957795f;

Float dot(const Vec3Lanes& a, const Vec3Lanes& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
Vec3Lanes scaled(const Vec3Lanes& a, Float s) { return {a.x * s, a.y * s, a.z * s}; }
Vec3Lanes cross(const Vec3Lanes& a, const Vec3Lanes& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
Vec3Lanes select(Bool condition, const Vec3Lanes& a, const Vec3Lanes& b) {
  return {lanes::select(condition, a.x, b.x), lanes::select(condition, a.y, b.y), lanes::select(condition, a.z, b.z)};
}
Float luminance(const std::array<Float, 3>& c) { return (c[0] + c[1] + c[2]) * (1.0f / 3); }

/// acos by Abramowitz and Stegun 4.4.45, absolute error 7e-5: far below the table's step of 10 degrees.
Float angle_of_cosine(Float c) {
  const Float x = lanes::clamp(c, 0.0f, 1.0f);
  return lanes::sqrt(1.0f - x) * (1.5707288f + x * (-0.2121144f + x * (0.0742610f + x * -0.0187293f)));
}

/// E[max(0, X)] of a Gaussian: the error function by Abramowitz and Stegun 7.1.26, absolute error 1.5e-7.
Float expected_positive(Float mean, Float variance) {
  const Float sigma = lanes::sqrt(lanes::max(variance, 1e-12f)), t = mean / sigma;
  const Float density = lanes::exp(-0.5f * lanes::min(t * t, 80.0f));
  const Float z = lanes::abs(t) * 0.70710678f, u = 1.0f / (1.0f + 0.3275911f * z);
  const Float tail =
      u * (0.254829592f + u * (-0.284496736f + u * (1.421413741f + u * (-1.453152027f + u * 1.061405429f)))) * density *
      0.5f;
  const Float below = lanes::select(t >= 0.0f, 1.0f - tail, tail);
  return lanes::max(mean * below + sigma * density * 0.39894228f, 0.0f);
}

/// A Gaussian on a plane.
struct PlaneGaussian {
  Float x, y, xx, xy, yy;
};

/// How the frame's x and y move the normal's component along `axis`: the normal's z moves with them.
struct Row {
  Float x, y;
};
Row row_of(const Vec3Lanes& axis, const Vec3Lanes& mean) {
  const Float tilt = axis.z / mean.z;
  return {axis.x - tilt * mean.x, axis.y - tilt * mean.y};
}
Float product(const Row& a, const NormalLanes& n, const Row& b) {
  return a.x * (n.xx * b.x + n.xy * b.y) + a.y * (n.xy * b.x + n.yy * b.y);
}

Vec3Lanes mean_normal(const NormalLanes& n) {
  return {n.x, n.y, lanes::sqrt(lanes::max(1.0f - n.x * n.x - n.y * n.y, kLeastMeanZ * kLeastMeanZ))};
}

PlaneGaussian project(const HalfVectorLanes& half, const NormalLanes& normals, const Vec3Lanes& mean) {
  const Row in_plane = row_of(half.in_plane, mean), across = row_of(half.across, mean);
  return {dot(half.in_plane, mean), dot(half.across, mean), product(in_plane, normals, in_plane),
          product(in_plane, normals, across), product(across, normals, across)};
}

/// table[index] of every lane.
Float gather(const float* table, const lanes::Int& index) {
#ifdef __AVX2__
  return (lanes::FloatRegister)_mm256_i32gather_ps(table, (__m256i)index.v, sizeof(float));
#else
  Float values;
  for (std::size_t i = 0; i < kLanes; ++i) values.v[i] = table[index.v[i]];
  return values;
#endif
}

}  // namespace

HalfVectorLanes half_vector(Vec3Lanes to_light, Vec3Lanes to_viewer) {
  HalfVectorLanes h;
  h.to_light = to_light;
  const Vec3Lanes sum{to_light.x + to_viewer.x, to_light.y + to_viewer.y, to_light.z + to_viewer.z};
  const Float length = lanes::sqrt(dot(sum, sum));
  const Bool has_half = length > kShortestHalf;
  h.half = select(has_half, scaled(sum, 1.0f / lanes::max(length, kShortestHalf)), Vec3Lanes{0.0f, 0.0f, -1.0f});
  const Float cosine = dot(h.half, to_light);
  h.theta_degrees = angle_of_cosine(cosine) * kDegrees;
  // In the plane of incidence; any direction where light and viewer coincide.
  const Vec3Lanes offset{to_light.x - h.half.x * cosine, to_light.y - h.half.y * cosine,
                         to_light.z - h.half.z * cosine};
  const Float norm = lanes::sqrt(dot(offset, offset));
  const Bool steep = lanes::abs(h.half.z) < 0.9f;
  const Vec3Lanes axis = select(steep, Vec3Lanes{0.0f, 0.0f, 1.0f}, Vec3Lanes{1.0f, 0.0f, 0.0f});
  const Vec3Lanes any = cross(h.half, axis);
  const Float any_norm = lanes::sqrt(lanes::max(dot(any, any), 1e-12f));
  h.in_plane =
      select(norm > 1e-4f && has_half, scaled(offset, 1.0f / lanes::max(norm, 1e-12f)), scaled(any, 1.0f / any_norm));
  h.across = cross(h.half, h.in_plane);
  return h;
}

LobeLanes lobes_at(const LobeModel& model, const WidthsInUse& in_use, lanes::Float theta_degrees) {
  constexpr float kLast = static_cast<float>(LobeModel::kAngles - 1);
  const Float position = lanes::clamp(theta_degrees * (1 / LobeModel::kAngleStep), 0.0f, kLast);
  const Float below = lanes::min(lanes::floor(position), kLast - 1.0f), part = position - below;
  const lanes::Int row = lanes::Int(below) * lanes::Int(LobeModel::kAngleFloats);
  const auto at = [&](const float& component) {
    const Float a = gather(&component, row), b = gather(&component + LobeModel::kAngleFloats, row);
    return a + (b - a) * part;
  };
  const LobeModel::Angle& table = model.angles[0];
  LobeLanes lobes;
  for (int c = 0; c < 3; ++c) lobes.constant[c] = at(table.constant[c]), lobes.cosine[c] = at(table.cosine[c]);
  for (int k = 0; k < LobeModel::kWidths; ++k)
    if (in_use[k])
      for (int c = 0; c < 3; ++c) lobes.amplitude[k][c] = at(table.amplitude[k][c]);
  lobes.stretch = at(table.stretch);
  return lobes;
}

LobeLanes broadcast(const LobeLanes& lobes, const WidthsInUse& in_use, std::size_t lane) {
  const auto one = [&](const std::array<Float, 3>& from) -> std::array<Float, 3> {
    return {from[0].v[lane], from[1].v[lane], from[2].v[lane]};
  };
  LobeLanes all;
  all.constant = one(lobes.constant);
  all.cosine = one(lobes.cosine);
  for (int k = 0; k < LobeModel::kWidths; ++k)
    if (in_use[k]) all.amplitude[k] = one(lobes.amplitude[k]);
  all.stretch = lobes.stretch.v[lane];
  return all;
}

HalfVectorLanes broadcast(const HalfVectorLanes& half, std::size_t lane) {
  const auto one = [&](const Vec3Lanes& v) -> Vec3Lanes { return {v.x.v[lane], v.y.v[lane], v.z.v[lane]}; };
  return {one(half.half), one(half.in_plane), one(half.across), one(half.to_light), half.theta_degrees.v[lane]};
}

WidthsInUse widths_in_use(const LobeModel& model) {
  WidthsInUse in_use{};
  for (const LobeModel::Angle& angle : model.angles)
    for (int k = 0; k < LobeModel::kWidths; ++k)
      for (float a : angle.amplitude[k]) in_use[k] = in_use[k] || a > 0;
  return in_use;
}

float narrowest_width(const LobeModel& model) {
  float narrowest = LobeModel::width(LobeModel::kWidths - 1);
  for (const LobeModel::Angle& angle : model.angles) {
    const auto brightness = [&](int k) {
      return angle.amplitude[k][0] + angle.amplitude[k][1] + angle.amplitude[k][2];
    };
    float peak = 0, sum = 0;
    for (int k = 0; k < LobeModel::kWidths; ++k) peak += brightness(k);
    for (int k = 0; k < LobeModel::kWidths; ++k) {
      sum += brightness(k);
      if (peak <= 0 || sum < kNarrowPart * peak) continue;
      narrowest = std::min(narrowest, LobeModel::width(k));
      break;
    }
  }
  return narrowest;
}

float narrowest_highlight(const LobeModel& model) {
  return model.error <= kTrustedError ? narrowest_width(model) : kNarrowestUnknown;
}

void add_distribution(const WidthsInUse& in_use, const LobeLanes& lobes, const HalfVectorLanes& half,
                      const NormalLanes& normals, lanes::Float weight, LobeSums& sums) {
  const Vec3Lanes mean = mean_normal(normals);
  sums.weight += weight, sums.x += weight * normals.x, sums.y += weight * normals.y;

  // Normals spread around their mean shorten it: their z falls short of the mean's own.
  const Float shorter = lanes::sqrt(lanes::max(mean.z * mean.z - normals.xx - normals.yy, kLeastMeanZ * kLeastMeanZ));
  const Row light = row_of(half.to_light, mean);
  const Float facing = half.to_light.x * normals.x + half.to_light.y * normals.y + half.to_light.z * shorter;
  sums.cosine += weight * expected_positive(facing, product(light, normals, light));

  const PlaneGaussian p = project(half, normals, mean);
  const Float sees = lanes::select(dot(half.half, mean) > kLeastFacing, weight, 0.0f);
  for (int k = 0; k < LobeModel::kWidths; ++k) {
    if (!in_use[k]) continue;
    const float s2 = LobeModel::width(k) * LobeModel::width(k);
    const Float lobe_xx = lobes.stretch * lobes.stretch * s2;
    const Float xx = p.xx + lobe_xx, yy = p.yy + s2;
    const Float inverse = 1.0f / (xx * yy - p.xy * p.xy);
    const Float ix = (yy * p.x - p.xy * p.y) * inverse, iy = (xx * p.y - p.xy * p.x) * inverse;
    const Float distance = lanes::min(0.5f * (p.x * ix + p.y * iy), 80.0f);
    const Float g = sees * lobes.stretch * s2 * lanes::sqrt(inverse) * lanes::exp(-distance);
    sums.gaussian[k] += g;
    const Float bright = g * luminance(lobes.amplitude[k]);
    sums.in_plane += bright * lobe_xx * ix;
    sums.across += bright * s2 * iy;
    sums.brightness += bright;
    const Float widths = p.xx / lobe_xx + p.yy * (1.0f / s2);
    sums.spread += bright * widths / (1.0f + widths);
  }
}

LobeValue integral(const WidthsInUse& in_use, const LobeLanes& lobes, const LobeSums& sums) {
  LobeValue value;
  for (int c = 0; c < 3; ++c) {
    value.smooth[c] = lobes.constant[c] * sums.weight + lobes.cosine[c] * sums.cosine;
    value.highlight[c] = 0.0f;
    for (int k = 0; k < LobeModel::kWidths; ++k)
      if (in_use[k]) value.highlight[c] += lobes.amplitude[k][c] * sums.gaussian[k];
  }
  return value;
}

LobeValue at_normal(const WidthsInUse& in_use, const LobeLanes& lobes, const HalfVectorLanes& half, Vec3Lanes normal) {
  LobeValue value;
  const Float facing = lanes::max(dot(half.to_light, normal), 0.0f);
  const Float x = dot(half.in_plane, normal) / lobes.stretch, y = dot(half.across, normal);
  const Float radius2 = x * x + y * y;
  const Bool sees = dot(half.half, normal) > kLeastFacing;
  for (int c = 0; c < 3; ++c) {
    value.smooth[c] = lobes.constant[c] + lobes.cosine[c] * facing;
    value.highlight[c] = 0.0f;
  }
  for (int k = 0; k < LobeModel::kWidths; ++k) {
    if (!in_use[k]) continue;
    const float s = LobeModel::width(k);
    const Float g = lanes::select(sees, lanes::exp(-lanes::min(radius2 * (0.5f / (s * s)), 80.0f)), 0.0f);
    for (int c = 0; c < 3; ++c) value.highlight[c] += lobes.amplitude[k][c] * g;
  }
  return value;
}

Vec3Lanes brightest_normal(const HalfVectorLanes& half, const LobeSums& sums) {
  const Float inverse = 1.0f / lanes::max(sums.brightness, 1e-30f);
  Float x = sums.in_plane * inverse, y = sums.across * inverse;
  // Not beyond where the lobes were fitted.
  const Float radius2 = x * x + y * y, shrink = lanes::select(radius2 > 0.9f, lanes::sqrt(0.9f / radius2), 1.0f);
  x *= shrink, y *= shrink;
  const Float z = lanes::sqrt(1.0f - x * x - y * y);
  return {half.half.x * z + half.in_plane.x * x + half.across.x * y,
          half.half.y * z + half.in_plane.y * x + half.across.y * y,
          half.half.z * z + half.in_plane.z * x + half.across.z * y};
}

ColourLanes calibrated(const LobeValue& whole, const LobeValue& model_there, const ColourLanes& reflectance_there) {
  ColourLanes result;
  for (int c = 0; c < 3; ++c) {
    const Float model = lanes::max(model_there.highlight[c], 1e-12f);
    const Float scale = lanes::clamp((reflectance_there[c] - model_there.smooth[c]) / model, 0.0f, kLargestScale);
    result[c] = whole.smooth[c] + scale * whole.highlight[c];
  }
  return result;
}

ColourLanes corrected(const LobeValue& whole, const LobeValue& model_there, const ColourLanes& reflectance_there,
                      lanes::Float weight) {
  ColourLanes result;
  for (int c = 0; c < 3; ++c) {
    const Float spread =
        whole.smooth[c] + whole.highlight[c] - weight * (model_there.smooth[c] + model_there.highlight[c]);
    result[c] = lanes::max(reflectance_there[c] + spread, 0.0f);
  }
  return result;
}

lanes::Float calibrated_part(const LobeSums& sums, const LobeValue& whole, const LobeValue& model_at_mean) {
  const Float there = sums.weight * luminance(model_at_mean.highlight), highlight = luminance(whole.highlight);
  const Float all = highlight + there + luminance(whole.smooth);
  const Float change = (lanes::abs(highlight - there) + sums.spread) / lanes::max(all, 1e-12f);
  const Float t = lanes::clamp((change - kCorrectedUpTo) * (1 / (kCalibratedFrom - kCorrectedUpTo)), 0.0f, 1.0f);
  return t * t * (3.0f - 2.0f * t);
}

}  // namespace redmap
