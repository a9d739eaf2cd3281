#include "map/footprint_texels.h"
#include "map/lookup_limits.h"

namespace redmap {
namespace {

/// The footprint, or if it is too narrow a box along its axes. Its shorter side in base texels goes to `width`.
Footprint widened(const Footprint& footprint, Extent extent, float& width) {
  const FootprintAxes axes = footprint_axes(footprint, extent);
  width = std::max({axes.minor, axes.major / kGatherAnisotropy, kGatherLeastWidth});
  if (width <= axes.minor) return footprint;
  const float columns = static_cast<float>(extent.width), rows = static_cast<float>(extent.height);
  const float major = std::max(axes.major, width);
  Vec2 along{axes.major_direction_uv.x * columns, axes.major_direction_uv.y * rows};  // in texels
  along = length(along) > 0 ? along * (1 / length(along)) : Vec2{1, 0};
  return {footprint.uv,
          {along.x * major / columns, along.y * major / rows},
          {-along.y * width / columns, along.x * width / rows}};
}

/// Index of the texel at `x`, from `low` to `high`: footprints may reach farther than an integer does.
int texel_at(float x, int low, int high) {
  return static_cast<int>(std::clamp(std::floor(x), static_cast<float>(low), static_cast<float>(high)));
}

}  // namespace

GatherPlan plan_gather(const Footprint& footprint, Extent extent, int levels, float texels) {
  GatherPlan plan;
  float width = 0;
  plan.footprint = widened(footprint, extent, width);
  const float position = std::clamp(std::log2(std::max(width / texels, 1.0f)), 0.0f, static_cast<float>(levels - 1));
  plan.level = std::min(static_cast<int>(position), std::max(0, levels - 2));
  plan.coarse_part =
      std::clamp((position - static_cast<float>(plan.level) - kGatherBlendFrom) / (1 - kGatherBlendFrom), 0.0f, 1.0f);
  return plan;
}

FootprintTexels::FootprintTexels(const Footprint& footprint, Extent extent, bool wraps_u)
    : wraps_u_(wraps_u), width_(extent.width) {
  const float columns = static_cast<float>(extent.width), rows = static_cast<float>(extent.height);
  dx_ = {footprint.duv_dx.x * columns, footprint.duv_dx.y * rows};
  dy_ = {footprint.duv_dy.x * columns, footprint.duv_dy.y * rows};
  const float determinant = dx_.x * dy_.y - dx_.y * dy_.x;
  to_a_ = Vec2{dy_.y, -dy_.x} * (1 / determinant), to_b_ = Vec2{-dx_.y, dx_.x} * (1 / determinant);
  half_a_ = 0.5f * (std::abs(to_a_.x) + std::abs(to_a_.y));
  half_b_ = 0.5f * (std::abs(to_b_.x) + std::abs(to_b_.y));
  centre_ = {footprint.uv.x * columns, footprint.uv.y * rows};
  const float reach_x = 0.5f * (std::abs(dx_.x) + std::abs(dy_.x)) + 0.5f;
  const float reach_y = 0.5f * (std::abs(dx_.y) + std::abs(dy_.y)) + 0.5f;
  // Beyond the edge on either side lies a texel that is not there, or a turn of those that are.
  y0_ = std::max(0, texel_at(centre_.y - reach_y, -1, extent.height));
  y1_ = std::min(extent.height - 1, texel_at(centre_.y + reach_y, -1, extent.height));
  x0_ = texel_at(centre_.x - reach_x, wraps_u ? -width_ : -1, wraps_u ? 2 * width_ : width_);
  x1_ = texel_at(centre_.x + reach_x, wraps_u ? -width_ : -1, wraps_u ? 2 * width_ : width_);
  if (wraps_u)
    x1_ = std::min(x1_, x0_ + width_ - 1);
  else
    x0_ = std::max(x0_, 0), x1_ = std::min(x1_, width_ - 1);
}

}  // namespace redmap
