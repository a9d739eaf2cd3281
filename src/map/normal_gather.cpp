// Gathering the normals under a footprint: raw texels, each by the area that the footprint has of it. What the
// footprint takes in matters more than how it is integrated afterwards (docs/normals.md).
#include <algorithm>
#include <array>
#include <cmath>

#include "map/footprint_texels.h"
#include "map/normal_pyramid.h"

namespace redmap {
namespace {

/// Footprints between asking for texels and using them.
constexpr std::size_t kAhead = 4;

void set(const NormalGaussian& normals, std::size_t i, NormalMixtures& out) {
  out.x[i] = normals.x, out.y[i] = normals.y;
  out.xx[i] = normals.xx, out.xy[i] = normals.xy, out.yy[i] = normals.yy;
}

PackedNormals packed_at(const std::uint8_t* bytes) {
  PackedNormals packed;
  std::copy_n(bytes, packed.bytes.size(), packed.bytes.begin());
  return packed;
}

/// The smaller of two differences where they have the same sign: an edge is no slope.
float limited(float a, float b) { return a * b <= 0 ? 0 : std::abs(a) < std::abs(b) ? a : b; }
Vec2 limited(Vec2 a, Vec2 b) { return {limited(a.x, b.x), limited(a.y, b.y)}; }

/// The normals of a part of a texel, which vary by `slope` over the whole.
void cut(const TexelPart& part, const NormalSlope& slope, NormalGaussian& normals) {
  normals.x += slope.along_x.x * part.offset.x + slope.along_y.x * part.offset.y;
  normals.y += slope.along_x.y * part.offset.x + slope.along_y.y * part.offset.y;
  const float xx = (slope.along_x.x * slope.along_x.x + slope.along_y.x * slope.along_y.x) / 12;
  const float yy = (slope.along_x.y * slope.along_x.y + slope.along_y.y * slope.along_y.y) / 12;
  const float xy = (slope.along_x.x * slope.along_x.y + slope.along_y.x * slope.along_y.y) / 12;
  const float missing = 0.5f * (part.missing_x + part.missing_y);
  // No more than there is, along either axis.
  const float most = std::min({1.0f, normals.xx / std::max(xx, 1e-12f), normals.yy / std::max(yy, 1e-12f)});
  normals.xx -= missing * most * xx, normals.xy -= missing * most * xy, normals.yy -= missing * most * yy;
  const float bound = std::sqrt(std::max(0.0f, normals.xx * normals.yy));
  normals.xy = std::clamp(normals.xy, -bound, bound);
}

}  // namespace

NormalSlope NormalPyramid::slope_at(const WeightPyramid& weights, int x, int y) const {
  const Extent base = extent(0);
  const auto mean = [&](int i, int j, Vec2& value) {
    if (weights.wraps_u()) i = (i + base.width) % base.width;
    if (i < 0 || i >= base.width || j < 0 || j >= base.height ||
        weights.row(0, j)[static_cast<std::size_t>(i) * weights.texel_stride()] == 0)
      return false;
    const std::uint8_t* b = texel(0, i, j);
    value = {static_cast<float>((b[0] | (b[1] & 15) << 8) - 2048) * (1 / kPackedMeanSteps),
             static_cast<float>((b[1] >> 4 | b[2] << 4) - 2048) * (1 / kPackedMeanSteps)};
    return true;
  };
  const auto slope = [&](int i, int j) {
    Vec2 before, here, after;
    if (!mean(x - i, y - j, before) || !mean(x, y, here) || !mean(x + i, y + j, after)) return Vec2{};
    return limited(here - before, after - here);
  };
  return {slope(1, 0), slope(0, 1)};
}

bool NormalPyramid::gather_level(int level, const Footprint& footprint, const WeightPyramid& weights, float part,
                                 std::uint32_t& count, NormalMixtures& out) const {
  const FootprintTexels texels(footprint, extent(level), weights.wraps_u());
  if (texels.most() == 0) return false;
  const std::uint32_t before = count;
  const int stride = weights.texel_stride(), gaussians = level == 0 ? 1 : kGaussians;
  out.make_room(count + texels.most() * gaussians);
  const std::uint8_t *weight_row = nullptr, *normal_row = nullptr;
  float total = 0;
  int row_index = 0;
  const auto row = [&](int y) {
    row_index = y, weight_row = weights.row(level, y).data(), normal_row = texel(level, 0, y);
  };
  texels.for_each(row, [&](int x, const TexelPart& texel_part) {
    const std::uint8_t* own = weight_row + static_cast<std::size_t>(x) * stride;  // coverage, then weights
    if (own[0] == 0) return;
    const float area = texel_part.area * static_cast<float>(own[0]);
    total += area;
    const std::uint8_t* bytes = normal_row + static_cast<std::size_t>(x) * texel_bytes(level);
    for (int g = 0; g < gaussians; ++g, bytes += 7 + basis_) {
      const std::uint8_t* parts = level == 0 ? own + 1 : bytes + 7;
      const float share = level == 0 ? area : area * static_cast<float>(bytes[6]) * (1.0f / 255);
      if (share == 0) continue;
      NormalGaussian normals = unpack(packed_at(bytes));
      if (level == 0 && !texel_part.whole()) cut(texel_part, slope_at(weights, x, row_index), normals);
      set(normals, count, out);
      for (int i = 0; i < basis_; ++i) out.weights[i][count] = share * static_cast<float>(parts[i]);
      ++count;
    }
  });
  for (int i = 0; i < basis_ && total > 0; ++i) {
    const float scale = part / total * weights.scales()[i] * (1.0f / 255);
    for (std::uint32_t k = before; k < count; ++k) out.weights[i][k] *= scale;
  }
  return total > 0;
}

void NormalPyramid::prefetch(int level, const FootprintTexels& texels, const WeightPyramid& weights) const {
  const int stride = weights.texel_stride();
  texels.for_each_row([&](int y, int first, int last) {
    const std::uint8_t* weight_row = weights.row(level, y).data();
    for (const int x : {first, last}) {
      __builtin_prefetch(weight_row + static_cast<std::size_t>(x) * stride);
      __builtin_prefetch(texel(level, x, y));
    }
  });
}

void NormalPyramid::gather(std::span<const Footprint> footprints, const WeightPyramid& weights, float texels,
                           NormalMixtures& out) const {
  struct Planned {
    bool usable = false;
    GatherPlan plan;
  };
  // The texels of a footprint are on their way while those before it are worked on.
  std::array<Planned, kAhead> ring;
  const auto plan = [&](std::size_t i) {
    Planned& next = ring[i % kAhead] = {};
    next.usable = is_finite(footprints[i]);
    if (!next.usable) return;
    next.plan = plan_gather(footprints[i], extent(0), levels(), texels);
    const int level = next.plan.level + (next.plan.coarse_part >= 1 ? 1 : 0);
    prefetch(level, FootprintTexels(next.plan.footprint, extent(level), weights.wraps_u()), weights);
  };
  for (std::size_t i = 0; i < std::min(kAhead - 1, footprints.size()); ++i) plan(i);
  for (std::size_t i = 0; i < footprints.size(); ++i) {
    if (i + kAhead - 1 < footprints.size()) plan(i + kAhead - 1);
    gather_one(footprints[i], ring[i % kAhead].usable, ring[i % kAhead].plan, weights, out);
  }
}

void NormalPyramid::gather_one(const Footprint& footprint, bool usable, const GatherPlan& plan,
                               const WeightPyramid& weights, NormalMixtures& out) const {
  const float coarse = plan.coarse_part;
  std::uint32_t count = out.first.back();
  const bool found = usable && coarse < 1 && gather_level(plan.level, plan.footprint, weights, 1 - coarse, count, out);
  // What is covered on the finer level is so on the coarser.
  const bool found_coarse =
      usable && coarse > 0 && gather_level(plan.level + 1, plan.footprint, weights, found ? coarse : 1, count, out);
  if (!found && !found_coarse) {
    // Between charts, or nowhere: what the weights have there, at one normal.
    const FilteredTexel texel = weights.lookup(footprint);
    out.make_room(count + 1);
    set({}, count, out);
    for (int b = 0; b < basis_; ++b) out.weights[b][count] = texel.channel[b];
    ++count;
  }
  out.first.push_back(count);
}

}  // namespace redmap
