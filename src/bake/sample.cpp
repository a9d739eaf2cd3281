#include "bake/sample.h"

#include <algorithm>
#include <unordered_set>

#include "analysis/basis.h"
#include "base/parallel.h"
#include "base/random.h"

namespace redmap {
namespace {

/// Texels that the row scales are estimated from, about: RMS to 1 %.
constexpr std::size_t kScaleTexels = 16384;
constexpr std::uint64_t kScaleSeed = 5;

/// Places that show whether a shader hides its shading frames, and how often to look for one.
constexpr std::size_t kSomePoints = 512, kMostTries = 4096;
constexpr std::uint64_t kPlaceSeed = 23;

const Vec2 kCentre[] = {{0.5f, 0.5f}};

/// What one tile in flight needs.
struct Scratch {
  std::vector<std::uint8_t> wanted;
  TexelPoints found;
  SurfacePoints batch;
  SampledReflectances sampled;
  std::vector<std::uint64_t> batch_keys;
  LaneVector<float> sums;
  std::string problem;  ///< empty: none
  // Distinct reflectances of the tile, in order of appearance.
  std::unordered_set<std::uint64_t> known;
  std::vector<std::uint64_t> keys;
  std::vector<float> scaled;
  std::vector<ReflectancePlace> places;
};

ReflectancePlace place_of(const SurfacePoints& points, std::size_t i) {
  return {points.position.get(i), points.normal.get(i), points.tangent.get(i), {points.uv[0][i], points.uv[1][i]}};
}

/// Keeps the distinct reflectances of a sampled batch.
void collect_distinct(const std::vector<float>& row_scales, Scratch& scratch) {
  const int rows = scratch.sampled.rows;
  for (std::size_t i = 0; i < scratch.batch_keys.size(); ++i) {
    const std::uint64_t key = scratch.batch_keys[i];
    if (i > 0 && key == scratch.batch_keys[i - 1]) continue;
    if (!scratch.known.insert(key).second) continue;
    scratch.keys.push_back(key);
    scratch.scaled.resize(scratch.keys.size() * rows);
    scaled_reflectance(scratch.sampled, i, row_scales, &scratch.scaled[(scratch.keys.size() - 1) * rows]);
    scratch.places.push_back(place_of(scratch.batch, i));
  }
}

void sample_tile(const TexelGrid& grid, const Shader& shader, TexelRegion region, SampledTexels& result,
                 Scratch& scratch) {
  scratch.known.clear(), scratch.keys.clear(), scratch.scaled.clear(), scratch.places.clear();
  grid.surface().rasterize(grid.extent(), region, kCentre, {}, scratch.found);
  for (std::size_t begin = 0; begin < scratch.found.points.size(); begin += kBatch) {
    const std::size_t end = std::min(scratch.found.points.size(), begin + kBatch);
    copy_points(scratch.found.points, begin, end, scratch.batch);
    result.sampler.sample(*shader.bind(scratch.batch), scratch.sampled);
    scratch.problem = find_problem(shader, scratch.batch, scratch.sampled);
    if (!scratch.problem.empty()) return;
    result.keys.compute(scratch.sampled, scratch.batch_keys, scratch.sums);
    collect_distinct(result.row_scales, scratch);
    for (std::size_t i = begin; i < end; ++i) {
      const std::size_t t = scratch.found.texel[i];
      result.id[(region.y + t / region.width) * grid.extent().width + region.x + t % region.width] =
          texel_id(scratch.batch_keys[i - begin]);
    }
  }
}

/// The paper hands on only the three most significant reflectances of a block.
std::vector<std::size_t> handed_on(const BakeOptions& options, const Scratch& scratch, int rows) {
  if (options.selection == BasisSelection::kPaper)
    return choose_basis({scratch.scaled, rows}, options.tolerance, kPaperPerBlock).chosen;
  std::vector<std::size_t> all(scratch.keys.size());
  for (std::size_t i = 0; i < all.size(); ++i) all[i] = i;
  return all;
}

}  // namespace

static_assert(kTile == kPaperBlock, "tiles are the paper's blocks");

std::string find_problem(const Shader& shader, const SurfacePoints& points, const SampledReflectances& sampled) {
  const std::optional<std::size_t> place = find_unsound_place(sampled);
  if (!place) return {};
  const Vec3 p = points.position.get(*place);
  return fmt::format(
      "bake: shader \"{}\": expected radiance, transmittance and emission to be numbers below {:.0e}, found another at "
      "position ({:g}, {:g}, {:g}) in object space",
      shader.info().name, kUnsoundValue, p.x, p.y, p.z);
}

SurfacePoints some_points(const TexelGrid& grid) {
  std::vector<ReflectancePlace> places;
  TexelPoints found;
  std::vector<std::uint8_t> wanted;
  for (std::size_t i = 0; i < kMostTries && places.size() < kSomePoints; ++i) {
    Random random(hash64(kPlaceSeed, i));
    const TexelRegion region = grid.tile(random.below(static_cast<std::uint32_t>(grid.tiles())));
    wanted.assign(static_cast<std::size_t>(region.width) * region.height, 0);
    wanted[random.below(static_cast<std::uint32_t>(wanted.size()))] = 1;
    grid.surface().rasterize(grid.extent(), region, kCentre, wanted, found);
    if (found.points.size() > 0) places.push_back(place_of(found.points, 0));
  }
  return points_at(places);
}

std::vector<float> estimate_row_scales(const TexelGrid& grid, const Shader& shader, const ReflectanceSampler& sampler,
                                       BakeMonitor& monitor) {
  // Some random texels of each tile, so that every part of the surface has its say.
  const std::size_t per_tile = std::max<std::size_t>(2, kScaleTexels / grid.tiles());
  std::vector<Scratch> slots(pipeline_slots());
  RowScaling scaling;
  const auto produce = [&](std::size_t index, std::size_t slot) {
    Scratch& scratch = slots[slot];
    const TexelRegion region = grid.tile(index);
    Random random(hash64(kScaleSeed, index));
    scratch.wanted.assign(static_cast<std::size_t>(region.width) * region.height, 0);
    for (std::size_t i = 0; i < per_tile; ++i)
      scratch.wanted[random.below(static_cast<std::uint32_t>(scratch.wanted.size()))] = 1;
    grid.surface().rasterize(grid.extent(), region, kCentre, scratch.wanted, scratch.found);
    scratch.sampled.places = 0;
    if (scratch.found.points.size() == 0 || monitor.stopped()) return;
    copy_points(scratch.found.points, 0, scratch.found.points.size(), scratch.batch);
    sampler.sample(*shader.bind(scratch.batch), scratch.sampled);
    scratch.problem = find_problem(shader, scratch.batch, scratch.sampled);
  };
  parallel_pipeline(grid.tiles(), produce, [&](std::size_t index, std::size_t slot) {
    if (!slots[slot].problem.empty()) monitor.fail(slots[slot].problem);
    if (slots[slot].sampled.places > 0) scaling.add(slots[slot].sampled);
    monitor.advance(static_cast<float>(index + 1) / static_cast<float>(grid.tiles()));
  });
  monitor.throw_if_stopped();
  if (scaling.places() == 0)
    throw Error("bake: no texel of {}x{} lies on the surface: expected uv that cover some of the unit square",
                grid.extent().width, grid.extent().height);
  std::vector<float> scales = scaling.scales();
  scales.resize(sampler.rows());
  return scales;
}

void sample_on_cpu(const BakeJob& job, SampledTexels& sampled) {
  const TexelGrid& grid = job.grid;
  const int rows = sampled.sampler.rows();
  std::vector<Scratch> slots(pipeline_slots());
  std::vector<std::vector<std::size_t>> chosen(pipeline_slots());
  const auto produce = [&](std::size_t index, std::size_t slot) {
    chosen[slot].clear();
    if (job.monitor.stopped()) return;
    sample_tile(grid, job.shader, grid.tile(index), sampled, slots[slot]);
    chosen[slot] = handed_on(job.options, slots[slot], rows);
  };
  parallel_pipeline(grid.tiles(), produce, [&](std::size_t index, std::size_t slot) {
    const Scratch& s = slots[slot];
    if (!s.problem.empty()) job.monitor.fail(s.problem);
    for (std::size_t i : chosen[slot]) sampled.unique.insert(s.keys[i], &s.scaled[i * rows], s.places[i]);
    job.monitor.advance(static_cast<float>(index + 1) / static_cast<float>(grid.tiles()));
  });
  job.monitor.throw_if_stopped();
  sampled.unique.finish();
}

SampledTexels sample_texels(const BakeJob& job, TexelPasses& passes) {
  job.monitor.begin("scale", 0.05f);
  const ReflectanceSampler sampler(job.shader.info(), job.directions);
  const std::vector<float> scales = estimate_row_scales(job.grid, job.shader, sampler, job.monitor);
  SampledTexels result{sampler, scales, ReflectanceKeys(scales), UniqueReflectances(sampler.rows(), kMaxUnique),
                       std::vector<std::uint32_t>(job.grid.texels())};
  job.monitor.begin("sample", 0.35f);
  passes.sample(job, result);
  return result;
}

}  // namespace redmap
