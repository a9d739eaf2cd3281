// Where the taps of a lookup are. The anisotropic plan matches the variance of the footprint, docs/lookup.md; the
// isotropic one is section 5.3 of the paper.
#include <algorithm>
#include <array>
#include <cmath>

#include "base/lanes_math.h"
#include "map/lookup_limits.h"
#include "map/pyramid.h"

namespace redmap {
namespace {

using lanes::Float;
using lanes::Int;

struct Vec2Lanes {
  Float x, y;
};

struct FootprintLanes {
  Vec2Lanes uv, duv_dx, duv_dy;
};

struct AxesLanes {
  Float major, minor;
  Vec2Lanes major_direction_uv;
};

/// The same footprint in every lane.
FootprintLanes broadcast(const Footprint& f) {
  return {{f.uv.x, f.uv.y}, {f.duv_dx.x, f.duv_dx.y}, {f.duv_dy.x, f.duv_dy.y}};
}

/// One footprint a lane, at most eight; the last one again where there are fewer.
FootprintLanes gather(std::span<const Footprint> footprints) {
  FootprintLanes f;
  for (std::size_t i = 0; i < kLanes; ++i) {
    const Footprint& from = footprints[std::min(i, footprints.size() - 1)];
    f.uv.x.v[i] = from.uv.x, f.uv.y.v[i] = from.uv.y;
    f.duv_dx.x.v[i] = from.duv_dx.x, f.duv_dx.y.v[i] = from.duv_dx.y;
    f.duv_dy.x.v[i] = from.duv_dy.x, f.duv_dy.y.v[i] = from.duv_dy.y;
  }
  return f;
}

AxesLanes axes_of(const FootprintLanes& footprint, Extent extent) {
  const Float width(static_cast<float>(extent.width)), height(static_cast<float>(extent.height));
  const Vec2Lanes x{footprint.duv_dx.x * width, footprint.duv_dx.y * height};
  const Vec2Lanes y{footprint.duv_dy.x * width, footprint.duv_dy.y * height};

  // Larger eigenvalue and its vector of J J^T; the smaller singular value from the determinant, which stays precise.
  const Float uu = x.x * x.x + y.x * y.x, uv = x.x * x.y + y.x * y.y, vv = x.y * x.y + y.y * y.y;
  const Float half_difference = 0.5f * (uu - vv);
  const Float root = lanes::sqrt(half_difference * half_difference + uv * uv);
  const Float major = lanes::sqrt(0.5f * (uu + vv) + root);
  const lanes::Bool along_u = half_difference >= 0.0f;
  const Vec2Lanes direction{lanes::select(along_u, half_difference + root, uv),
                            lanes::select(along_u, uv, root - half_difference)};
  const Float norm = lanes::sqrt(direction.x * direction.x + direction.y * direction.y);

  // A circle has no direction: u will do. A footprint of no size, or of one that is no number, has no axes.
  const lanes::Bool has_direction = norm > 0.0f, has_size = major > 0.0f;
  const Float scale = major / norm;
  const Vec2Lanes spanned{lanes::select(has_direction, direction.x * scale, major),
                          lanes::select(has_direction, direction.y * scale, 0.0f)};
  const Float minor = lanes::abs(x.x * y.y - x.y * y.x) / major;
  return {lanes::select(has_size, major, 0.0f),
          lanes::select(has_size, minor, 0.0f),
          {lanes::select(has_size, spanned.x / width, 0.0f), lanes::select(has_size, spanned.y / height, 0.0f)}};
}

struct PlanLanes {
  Vec2Lanes first_uv, step_uv;
  Int taps, level;
  Float coarse_part;

  LookupPlan lane(std::size_t i) const {
    return {
        {first_uv.x.v[i], first_uv.y.v[i]}, {step_uv.x.v[i], step_uv.y.v[i]}, taps.v[i], level.v[i], coarse_part.v[i]};
  }
};

PlanLanes plan_variance_matched(const FootprintLanes& footprint, Extent extent, int levels) {
  const AxesLanes axes = axes_of(footprint, extent);
  const Float texel = lanes::max(kTexelPerMinor * lanes::max(axes.minor, axes.major * (1 / kLookupAnisotropy)), 1.0f);

  // What the tap's own width leaves of the major axis is covered by n taps: variance h^2 (n^2 - 1) / 12 = rest^2 / 12.
  const Float rest = lanes::sqrt(lanes::max(axes.major * axes.major - 3.0f * texel * texel, 0.0f));
  const lanes::Bool is_long = rest > 0.5f * texel;
  const Float needed = -lanes::floor(-(rest / (kTapSpacing * texel) + 0.5f));
  const Float taps = lanes::select(is_long, lanes::clamp(needed, 2.0f, kMaxTaps), 1.0f);
  const Float step = lanes::select(is_long, rest / (axes.major * lanes::sqrt(taps * taps - 1.0f)), 0.0f);
  const Vec2Lanes step_uv{axes.major_direction_uv.x * step, axes.major_direction_uv.y * step};
  const Float before = 0.5f * (taps - 1.0f);

  // Between two levels the variances add up to that of the texel wanted: (1 - f) c0^2 + f (2 c0)^2 = c^2. The level is
  // the logarithm of the texel, which is the exponent of the float.
  const Float exponent{Int(((lanes::IntRegister)texel.v >> 23) - 127)};
  const Int level(lanes::min(exponent, static_cast<float>(std::max(0, levels - 2))));
  const Float ratio = texel * Float((lanes::FloatRegister)((127 - level.v) << 23));
  const Float coarse_part = levels > 1 ? lanes::clamp((ratio * ratio - 1.0f) * (1.0f / 3), 0.0f, 1.0f) : Float(0.0f);
  return {{footprint.uv.x - step_uv.x * before, footprint.uv.y - step_uv.y * before},
          step_uv,
          Int(taps),
          level,
          coarse_part};
}

LookupPlan plan_enclosing_square(const Footprint& f, Extent extent, int levels) {
  const float across = (std::abs(f.duv_dx.x) + std::abs(f.duv_dy.x)) * static_cast<float>(extent.width);
  const float down = (std::abs(f.duv_dx.y) + std::abs(f.duv_dy.y)) * static_cast<float>(extent.height);
  const float level = std::clamp(std::log2(std::max({across, down, 1.0f})), 0.0f, static_cast<float>(levels - 1));
  LookupPlan plan;
  plan.first_uv = f.uv;
  plan.level = std::min(static_cast<int>(level), std::max(0, levels - 2));
  plan.coarse_part = level - static_cast<float>(plan.level);
  return plan;
}

/// The centre of the coarsest level.
LookupPlan plan_unknown(int levels) { return {{0.5f, 0.5f}, {}, 1, std::max(0, levels - 2), levels > 1 ? 1.0f : 0.0f}; }

bool is_finite(const Footprint& f) {
  return std::isfinite(f.uv.x + f.uv.y + f.duv_dx.x + f.duv_dx.y + f.duv_dy.x + f.duv_dy.y);
}

}  // namespace

FootprintAxes footprint_axes(const Footprint& footprint, Extent extent) {
  const AxesLanes axes = axes_of(broadcast(footprint), extent);
  return {axes.major.v[0], axes.minor.v[0], {axes.major_direction_uv.x.v[0], axes.major_direction_uv.y.v[0]}};
}

LookupPlan plan_lookup(const Footprint& footprint, Extent extent, int levels, LookupFilter filter) {
  if (!is_finite(footprint)) return plan_unknown(levels);
  if (filter == LookupFilter::kEnclosingSquare) return plan_enclosing_square(footprint, extent, levels);
  return plan_variance_matched(broadcast(footprint), extent, levels).lane(0);
}

void plan_lookups(std::span<const Footprint> footprints, Extent extent, int levels, LookupFilter filter,
                  std::span<LookupPlan> out) {
  if (filter == LookupFilter::kEnclosingSquare) {
    for (std::size_t i = 0; i < out.size(); ++i) out[i] = plan_lookup(footprints[i], extent, levels, filter);
    return;
  }
  for (std::size_t first = 0; first < footprints.size(); first += kLanes) {
    const auto some = footprints.subspan(first, std::min(kLanes, footprints.size() - first));
    const PlanLanes plans = plan_variance_matched(gather(some), extent, levels);
    for (std::size_t i = 0; i < some.size(); ++i)
      out[first + i] = is_finite(some[i]) ? plans.lane(i) : plan_unknown(levels);
  }
}

}  // namespace redmap
