#include "bake/texel_grid.h"

#include <algorithm>

#include "base/parallel.h"

namespace redmap {
namespace {

/// What one tile in flight needs.
struct Scratch {
  std::vector<std::uint8_t> wanted;
  TexelPoints found;
  SurfacePoints batch;
  std::vector<std::size_t> texel;
  std::vector<float> values;
};

/// Index in the whole grid of texel `index` of `region`.
std::size_t texel_in_grid(Extent extent, TexelRegion region, std::size_t index) {
  return (region.y + index / region.width) * extent.width + region.x + index % region.width;
}

void evaluate_in_batches(Extent extent, TexelRegion region, int channels, const EvaluatePoints& evaluate,
                         std::size_t slot, Scratch& scratch) {
  const std::size_t count = scratch.found.points.size();
  scratch.values.resize(count * channels);
  scratch.texel.resize(count);
  for (std::size_t i = 0; i < count; ++i) scratch.texel[i] = texel_in_grid(extent, region, scratch.found.texel[i]);
  for (std::size_t begin = 0; begin < count; begin += kBatch) {
    const std::size_t end = std::min(count, begin + kBatch);
    copy_points(scratch.found.points, begin, end, scratch.batch);
    evaluate(scratch.batch, {&scratch.texel[begin], end - begin}, slot, &scratch.values[begin * channels]);
  }
}

/// Sums up the points, which are ordered by texel, and divides by their number.
void write_averages(TexelRegion region, int points_per_texel, const Scratch& scratch, BaseLevel& base) {
  for (std::size_t i = 0; i < scratch.wanted.size(); ++i)
    if (scratch.wanted[i]) base.coverage[texel_in_grid(base.extent, region, i)] = 0;
  const int channels = base.channels;
  for (std::size_t begin = 0, end = 0; begin < scratch.texel.size(); begin = end) {
    const std::size_t texel = scratch.texel[begin];
    float* values = &base.values[texel * channels];
    std::fill_n(values, channels, 0.0f);
    for (end = begin; end < scratch.texel.size() && scratch.texel[end] == texel; ++end)
      for (int c = 0; c < channels; ++c) values[c] += scratch.values[end * channels + c];
    const float points = static_cast<float>(end - begin);
    for (int c = 0; c < channels; ++c) values[c] /= points;
    base.coverage[texel] = points / static_cast<float>(points_per_texel);
  }
}

}  // namespace

void BakeMonitor::begin(std::string_view name, float end) {
  name_ = name;
  begin_ = end_;
  end_ = end;
  advance(0);
}

void BakeMonitor::advance(float part_of_stage) {
  if (callback_ && !stopped_) stopped_ = !callback_(begin_ + (end_ - begin_) * part_of_stage, name_);
}

void BakeMonitor::fail(const std::string& problem) {
  if (!stopped_) problem_ = problem;
  stopped_ = true;
}

void BakeMonitor::throw_if_stopped() const {
  if (!problem_.empty()) throw Error(problem_);
  if (stopped_) throw BakeInterrupted();
}

TexelGrid::TexelGrid(const Surface& surface, int size)
    : surface_(surface),
      extent_(surface.map_extent(size)),
      across_((extent_.width + kTile - 1) / kTile),
      down_((extent_.height + kTile - 1) / kTile) {}

TexelRegion TexelGrid::tile(std::size_t index) const {
  const int x = static_cast<int>(index) % across_ * kTile, y = static_cast<int>(index) / across_ * kTile;
  return {x, y, std::min(kTile, extent_.width - x), std::min(kTile, extent_.height - y)};
}

std::vector<Vec2> sub_sample_offsets(int n) {
  std::vector<Vec2> offsets;
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i)
      offsets.push_back({(static_cast<float>(i) + 0.5f) / static_cast<float>(n),
                         (static_cast<float>(j) + 0.5f) / static_cast<float>(n)});
  return offsets;
}

void copy_points(const SurfacePoints& points, std::size_t begin, std::size_t end, SurfacePoints& out) {
  out.resize(end - begin);
  out.time = points.time;
  const auto copy = [&](const auto& from, auto& to, int components) {
    for (int c = 0; c < components; ++c) {
      std::copy_n(from[c] + begin, end - begin, to[c]);
      std::fill(to[c] + (end - begin), to[c] + to.stride(), from[c][end - 1]);
    }
  };
  copy(points.position, out.position, 3);
  copy(points.normal, out.normal, 3);
  copy(points.tangent, out.tangent, 3);
  copy(points.uv, out.uv, 2);
}

std::vector<std::uint8_t> find_differing_texels(const BaseLevel& base, const ValuesDiffer& differ) {
  const auto [width, height] = base.extent;
  std::vector<std::uint8_t> differing(base.coverage.size());
  const auto alike = [&](std::size_t a, std::size_t b) {
    if ((base.coverage[a] > 0) != (base.coverage[b] > 0)) return false;
    const float *values_a = &base.values[a * base.channels], *values_b = &base.values[b * base.channels];
    // Nearly all neighbours are equal; only the others are worth a call.
    return base.coverage[a] <= 0 || std::equal(values_a, values_a + base.channels, values_b) ||
           !differ(values_a, values_b);
  };
  parallel_for(height, [&](std::size_t y) {
    for (int x = 0; x < width; ++x) {
      const std::size_t here = y * width + x;
      for (int j = -1; j <= 1 && !differing[here]; ++j)
        for (int i = -1; i <= 1 && !differing[here]; ++i) {
          const int row = std::clamp(static_cast<int>(y) + j, 0, height - 1);
          const int column = base.wraps_u ? (x + i + width) % width : std::clamp(x + i, 0, width - 1);
          differing[here] = !alike(here, static_cast<std::size_t>(row) * width + column);
        }
    }
  });
  return differing;
}

void average_texels(const TexelGrid& grid, std::span<const std::uint8_t> wanted, int sub_samples,
                    const EvaluatePoints& evaluate, const TileDone& done, BakeMonitor& monitor, BaseLevel& base) {
  const std::vector<Vec2> offsets = sub_sample_offsets(sub_samples);
  std::vector<Scratch> slots(pipeline_slots());
  const auto produce = [&](std::size_t index, std::size_t slot) {
    Scratch& scratch = slots[slot];
    const TexelRegion region = grid.tile(index);
    scratch.wanted.resize(static_cast<std::size_t>(region.width) * region.height);
    for (std::size_t i = 0; i < scratch.wanted.size(); ++i)
      scratch.wanted[i] = wanted[texel_in_grid(grid.extent(), region, i)];
    const bool any = std::find(scratch.wanted.begin(), scratch.wanted.end(), 1) != scratch.wanted.end();
    if (!any || monitor.stopped()) return;
    grid.surface().rasterize(grid.extent(), region, offsets, scratch.wanted, scratch.found);
    evaluate_in_batches(grid.extent(), region, base.channels, evaluate, slot, scratch);
    write_averages(region, static_cast<int>(offsets.size()), scratch, base);
  };
  parallel_pipeline(grid.tiles(), produce, [&](std::size_t index, std::size_t slot) {
    if (done) done(slot);
    monitor.advance(static_cast<float>(index + 1) / static_cast<float>(grid.tiles()));
  });
  monitor.throw_if_stopped();
}

}  // namespace redmap
