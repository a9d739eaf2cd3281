// Gathering the normals under a footprint: raw texels, each by the area that the footprint has of it. What the
// footprint takes in matters more than how it is integrated afterwards (docs/normals.md).
#include <algorithm>
#include <cmath>

#include "map/normal_pyramid.h"

namespace redmap {
namespace {

/// Footprints longer than this are widened: the texels of a lookup stay few.
constexpr float kMaxAnisotropy = 6;
/// And narrower ones than this part of a base texel too.
constexpr float kLeastWidth = 0.5f;
/// From this part of the way between two levels on they are mixed, so that nothing pops.
constexpr float kBlendFrom = 0.6f;

/// The footprint, or if it is too narrow a box along its axes. Its shorter side in base texels goes to `width`.
Footprint widened(const Footprint& footprint, Extent extent, float& width) {
  const FootprintAxes axes = footprint_axes(footprint, extent);
  width = std::max({axes.minor, axes.major / kMaxAnisotropy, kLeastWidth});
  if (width <= axes.minor) return footprint;
  const float columns = static_cast<float>(extent.width), rows = static_cast<float>(extent.height);
  const float major = std::max(axes.major, width);
  Vec2 along{axes.major_direction_uv.x * columns, axes.major_direction_uv.y * rows};  // in texels
  along = length(along) > 0 ? along * (1 / length(along)) : Vec2{1, 0};
  return {footprint.uv,
          {along.x * major / columns, along.y * major / rows},
          {-along.y * width / columns, along.x * width / rows}};
}

/// How much of [a - half, a + half] lies in [-1/2, 1/2].
float overlap(float a, float half) { return std::min(a + half, 0.5f) - std::max(a - half, -0.5f); }

/// Index of the texel at `x`, from `low` to `high`: footprints may reach farther than an integer does.
int texel_at(float x, int low, int high) {
  return static_cast<int>(std::clamp(std::floor(x), static_cast<float>(low), static_cast<float>(high)));
}

bool is_finite(const Footprint& f) {
  return std::isfinite(f.uv.x + f.uv.y + f.duv_dx.x + f.duv_dx.y + f.duv_dy.x + f.duv_dy.y);
}

void set(const NormalGaussian& normals, std::size_t i, NormalMixtures& out) {
  out.x[i] = normals.x, out.y[i] = normals.y;
  out.xx[i] = normals.xx, out.xy[i] = normals.xy, out.yy[i] = normals.yy;
}

PackedNormals packed_at(const std::uint8_t* bytes) {
  PackedNormals packed;
  std::copy_n(bytes, packed.bytes.size(), packed.bytes.begin());
  return packed;
}

}  // namespace

bool NormalPyramid::gather_level(int level, const Footprint& footprint, const WeightPyramid& weights, float part,
                                 std::uint32_t& count, NormalMixtures& out) const {
  const auto [width, height] = extent(level);
  const float columns = static_cast<float>(width), rows = static_cast<float>(height);
  const Vec2 dx{footprint.duv_dx.x * columns, footprint.duv_dx.y * rows};
  const Vec2 dy{footprint.duv_dy.x * columns, footprint.duv_dy.y * rows};
  // Texels to footprint coordinates, in which the footprint is the unit square; and half the size of a texel there.
  const float determinant = dx.x * dy.y - dx.y * dy.x;
  const Vec2 to_a = Vec2{dy.y, -dy.x} * (1 / determinant), to_b = Vec2{-dx.y, dx.x} * (1 / determinant);
  const float half_a = 0.5f * (std::abs(to_a.x) + std::abs(to_a.y));
  const float half_b = 0.5f * (std::abs(to_b.x) + std::abs(to_b.y));
  const Vec2 centre{footprint.uv.x * columns, footprint.uv.y * rows};
  const float reach_x = 0.5f * (std::abs(dx.x) + std::abs(dy.x)) + 0.5f;
  const float reach_y = 0.5f * (std::abs(dx.y) + std::abs(dy.y)) + 0.5f;
  // Beyond the edge on either side lies a texel that is not there, or a turn of those that are.
  const bool wraps = weights.wraps_u();
  const int y0 = std::max(0, texel_at(centre.y - reach_y, -1, height));
  const int y1 = std::min(height - 1, texel_at(centre.y + reach_y, -1, height));
  int x0 = texel_at(centre.x - reach_x, wraps ? -width : -1, wraps ? 2 * width : width);
  int x1 = texel_at(centre.x + reach_x, wraps ? -width : -1, wraps ? 2 * width : width);
  if (wraps)
    x1 = std::min(x1, x0 + width - 1);
  else
    x0 = std::max(x0, 0), x1 = std::min(x1, width - 1);
  if (x1 < x0 || y1 < y0) return false;

  const std::uint32_t before = count;
  out.make_room(count + static_cast<std::size_t>(x1 - x0 + 1) * (y1 - y0 + 1) * kGaussians);
  const int stride = weights.texel_stride(), gaussians = level == 0 ? 1 : kGaussians;
  float total = 0;
  for (int y = y0; y <= y1; ++y) {
    const std::uint8_t* weight_row = weights.row(level, y).data();
    const std::uint8_t* normal_row = texel(level, 0, y);
    for (int x = x0; x <= x1; ++x) {
      const Vec2 offset{static_cast<float>(x) + 0.5f - centre.x, static_cast<float>(y) + 0.5f - centre.y};
      const float a = overlap(dot(to_a, offset), half_a), b = overlap(dot(to_b, offset), half_b);
      if (a <= 0 || b <= 0) continue;
      const int column = wraps ? ((x % width) + width) % width : x;
      const std::uint8_t* own = weight_row + static_cast<std::size_t>(column) * stride;  // coverage, then weights
      if (own[0] == 0) continue;
      const float area = a * b * static_cast<float>(own[0]);
      total += area;
      const std::uint8_t* bytes = normal_row + static_cast<std::size_t>(column) * texel_bytes(level);
      for (int g = 0; g < gaussians; ++g, bytes += 7 + basis_) {
        const std::uint8_t* parts = level == 0 ? own + 1 : bytes + 7;
        const float share = level == 0 ? area : area * static_cast<float>(bytes[6]) * (1.0f / 255);
        if (share == 0) continue;
        set(unpack(packed_at(bytes)), count, out);
        for (int i = 0; i < basis_; ++i) out.weights[i][count] = share * static_cast<float>(parts[i]);
        ++count;
      }
    }
  }
  for (int i = 0; i < basis_ && total > 0; ++i) {
    const float scale = part / total * weights.scales()[i] * (1.0f / 255);
    for (std::uint32_t k = before; k < count; ++k) out.weights[i][k] *= scale;
  }
  return total > 0;
}

void NormalPyramid::gather(std::span<const Footprint> footprints, const WeightPyramid& weights, float texels,
                           NormalMixtures& out) const {
  for (const Footprint& each : footprints) {
    float width = 0;
    const bool usable = is_finite(each);
    const Footprint footprint = usable ? widened(each, extent(0), width) : each;
    const float position =
        std::clamp(std::log2(std::max(width / texels, 1.0f)), 0.0f, static_cast<float>(levels() - 1));
    const int level = std::min(static_cast<int>(position), std::max(0, levels() - 2));
    const float coarse = std::clamp((position - static_cast<float>(level) - kBlendFrom) / (1 - kBlendFrom), 0.0f, 1.0f);
    std::uint32_t count = out.first.back();
    const bool found = usable && coarse < 1 && gather_level(level, footprint, weights, 1 - coarse, count, out);
    // What is covered on the finer level is so on the coarser.
    const bool found_coarse =
        usable && coarse > 0 && gather_level(level + 1, footprint, weights, found ? coarse : 1, count, out);
    if (!found && !found_coarse) {
      // Between charts, or nowhere: what the weights have there, at one normal.
      const FilteredTexel texel = weights.lookup(each);
      out.make_room(count + 1);
      set({}, count, out);
      for (int b = 0; b < basis_; ++b) out.weights[b][count] = texel.channel[b];
      ++count;
    }
    out.first.push_back(count);
  }
}

}  // namespace redmap
