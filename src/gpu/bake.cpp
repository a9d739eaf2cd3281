#include "gpu/bake.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <unordered_set>

#include "bake/project.h"
#include "bake/sample.h"
#include "base/parallel.h"
#include "gpu/bake_kernels.h"
#include "gpu/key_weights.h"

namespace redmap {
namespace {

const Vec2 kCentre[] = {{0.5f, 0.5f}};

/// Places whose reflectances are asked for together on the host.
constexpr std::size_t kVectorBatch = 2048;

/// Up to so many distinct reflectances, sub-samples hardly ever show another one. Then their keys say all, and a second
/// shader need not be compiled, which takes longer than it would run.
constexpr std::size_t kFewReflectances = 512;

/// Tiles whose points are on the device together.
std::vector<std::vector<std::size_t>> make_batches(const TexelGrid& grid, std::span<const std::uint8_t> wanted,
                                                   std::size_t points_per_texel, std::size_t most_points) {
  std::vector<std::vector<std::size_t>> batches;
  std::size_t points = most_points;
  for (std::size_t t = 0; t < grid.tiles(); ++t) {
    const TexelRegion region = grid.tile(t);
    std::size_t more = static_cast<std::size_t>(region.width) * region.height;
    if (!wanted.empty()) {
      const std::size_t texels = std::exchange(more, 0);
      for (std::size_t i = 0; i < texels; ++i) more += wanted[grid.texel(region, i)];
    }
    more *= points_per_texel;
    if (more == 0) continue;
    if (points + more > most_points) batches.emplace_back(), points = 0;
    batches.back().push_back(t), points += more;
  }
  return batches;
}

/// Says what is wrong at `point`, which is asked once more in the plain way: whoever is told reads the same as after a
/// bake on the CPU.
std::string problem_at(const BakeJob& job, const ReflectanceSampler& sampler, const SurfacePoints& point) {
  try {
    SampledReflectances sampled;
    sampler.sample(*job.shader.bind(point), sampled);
    if (std::string problem = find_problem(job.shader, point, sampled); !problem.empty()) return problem;
  } catch (const Error& error) {
    return error.what();
  }
  const Vec3 p = point.position.get(0);
  return fmt::format(
      "bake: shader \"{}\": expected sound numbers on the device, found others at position ({:g}, {:g}, "
      "{:g}) in object space",
      job.shader.info().name, p.x, p.y, p.z);
}

using FourWords = std::array<std::uint32_t, 4>;
constexpr auto bits = [](float value) { return std::bit_cast<std::uint32_t>(value); };

/// Open addressing, then the residual and the weights of each key.
std::vector<FourWords> known_table(const KnownWeights& known, int basis, std::uint32_t& slots) {
  slots = static_cast<std::uint32_t>(std::bit_ceil(2 * known.weights.size() + 2));
  const std::size_t vectors = weight_vectors(basis);
  std::vector<FourWords> table(slots + known.weights.size() * vectors);
  // In the order of the weights, so that the table is the same from run to run.
  std::vector<std::uint64_t> key_of(known.weights.size());
  for (const auto& [key, index] : known.of_key) key_of[index] = key;
  for (std::uint32_t i = 0; i < key_of.size(); ++i) {
    const auto low = static_cast<std::uint32_t>(key_of[i]), high = static_cast<std::uint32_t>(key_of[i] >> 32);
    std::uint32_t slot = low & (slots - 1);
    while (table[slot][2] != 0) slot = (slot + 1) & (slots - 1);
    table[slot] = {low, high, i + 1, 0};
    FourWords* to = &table[slots + i * vectors];
    to[0][0] = bits(known.residuals[i]);
    for (int b = 0; b < basis; ++b) to[1 + b / 4][b % 4] = bits(known.weights[i][b]);
  }
  return table;
}

template <typename Value>
DeviceBuffer upload(const Device& device, const std::vector<Value>& values) {
  DeviceBuffer buffer(device, values.size() * sizeof(Value));
  std::memcpy(buffer.data(), values.data(), values.size() * sizeof(Value));
  return buffer;
}

/// The outlier at `place`, so that the basis can be extended by it.
void add_outlier(const BakeJob& job, const SampledTexels& sampled, const ReflectancePlace& place,
                 ProjectedPoints& projected) {
  SampledReflectances reflectance;
  std::vector<std::uint64_t> keys;
  LaneVector<float> sums;
  sampled.sampler.sample(*job.shader.bind(points_at(std::vector{place})), reflectance);
  sampled.keys.compute(reflectance, keys, sums);
  std::vector<float> scaled(reflectance.rows);
  scaled_reflectance(reflectance, 0, sampled.row_scales, scaled.data());
  projected.outliers.insert(keys[0], scaled.data(), place);
}

/// What texels are averaged with.
struct Averaging {
  const SampledTexels& sampled;
  const ChosenBasis& basis;
  const KnownWeights& known;
  std::span<const std::uint8_t> wanted;
  std::vector<Vec2> offsets;
  bool by_keys;  ///< weigh_by_keys() instead of the shader of weight_text()
  BakeCall call;
};

class DevicePasses final : public TexelPasses {
 public:
  explicit DevicePasses(std::string device) : device_(std::move(device)) {}
  void sample(const BakeJob& job, SampledTexels& sampled) override;
  ProjectedPoints average(const BakeJob& job, const SampledTexels& sampled, const ChosenBasis& basis,
                          const KnownWeights& known, std::span<const std::uint8_t> wanted, int sub_samples,
                          BaseLevel& base) override;
  WeightPyramid build_pyramid(const BaseLevel& base) override { return WeightPyramid(base); }

 private:
  struct SampleSlot;
  struct AverageSlot;
  void sample_batch(const BakeJob& job, std::span<const std::size_t> tiles, SampledTexels& sampled, SampleSlot& slot);
  void average_batch(const BakeJob& job, std::span<const std::size_t> tiles, const Averaging& with, BaseLevel& base,
                     AverageSlot& slot);

  const std::string device_;
  // Made by sample(), so that a bake's report has the time it takes.
  std::optional<BakeKernels> kernels_;
  std::optional<ComputePipeline> keys_;
  // For a basis of these reflectances: as many texels as differ are averaged by it after all that are unknown.
  std::optional<ComputePipeline> weights_;
  std::vector<float> weights_basis_;
};

/// Rasterizes the tiles of a batch.
struct TileScratch {
  std::vector<std::uint8_t> wanted;
  TexelPoints found;
  std::vector<std::size_t> texel;

  void rasterize(const TexelGrid& grid, std::span<const std::size_t> tiles, std::span<const Vec2> offsets,
                 std::span<const std::uint8_t> wanted_texels, PointBatch& batch) {
    batch.clear();
    for (const std::size_t tile : tiles) {
      const TexelRegion region = grid.tile(tile);
      if (!wanted_texels.empty()) {
        wanted.resize(static_cast<std::size_t>(region.width) * region.height);
        for (std::size_t i = 0; i < wanted.size(); ++i) wanted[i] = wanted_texels[grid.texel(region, i)];
      }
      grid.surface().rasterize(grid.extent(), region, offsets, wanted, found);
      texel.resize(found.texel.size());
      for (std::size_t i = 0; i < texel.size(); ++i) texel[i] = grid.texel(region, found.texel[i]);
      batch.add(found.points, texel);
    }
  }
};

struct DevicePasses::SampleSlot {
  std::optional<PointBatch> batch;
  TileScratch scratch;
  std::string problem;  ///< empty: none
  // Distinct keys of the batch, in order of appearance, and the points they were met at.
  std::unordered_set<std::uint64_t> met;
  std::vector<std::pair<std::uint64_t, std::size_t>> distinct;
};

void DevicePasses::sample_batch(const BakeJob& job, std::span<const std::size_t> tiles, SampledTexels& sampled,
                                SampleSlot& slot) {
  PointBatch& batch = *slot.batch;
  slot.met.clear(), slot.distinct.clear();
  slot.scratch.rasterize(job.grid, tiles, kCentre, {}, batch);
  BakeCall call;
  call.count = static_cast<std::uint32_t>(batch.points());
  if (const auto bad = batch.run(call)) {
    slot.problem = problem_at(job, sampled.sampler, batch.point(*bad));
    return;
  }
  for (std::size_t i = 0; i < batch.points(); ++i) {
    const std::uint64_t key = batch.key(i);
    sampled.id[batch.texels()[i]] = texel_id(key);
    if (i > 0 && key == batch.key(i - 1)) continue;
    if (slot.met.insert(key).second) slot.distinct.emplace_back(key, i);
  }
}

/// The vectors of the distinct reflectances, from which the CPU chooses.
void fill_in_vectors(const BakeJob& job, SampledTexels& sampled) {
  UniqueReflectances& unique = sampled.unique;
  parallel_for((unique.size() + kVectorBatch - 1) / kVectorBatch, [&](std::size_t batch) {
    const std::size_t begin = batch * kVectorBatch, count = std::min(kVectorBatch, unique.size() - begin);
    std::vector<ReflectancePlace> places;
    for (std::size_t i = begin; i < begin + count; ++i) places.push_back(unique.place(i));
    SampledReflectances reflectances;
    sampled.sampler.sample(*job.shader.bind(points_at(places)), reflectances);
    for (std::size_t i = 0; i < count; ++i)
      scaled_reflectance(reflectances, i, sampled.row_scales, unique.scaled(begin + i));
  });
}

void DevicePasses::sample(const BakeJob& job, SampledTexels& sampled) {
  kernels_.emplace(job.shader, device_);
  const Device& device = *kernels_->device();
  const DeviceBuffer nothing_known(device, sizeof(FourWords));
  const std::size_t most = std::max<std::size_t>(kernels_->batch_points(), kTile * kTile);
  const auto batches = make_batches(job.grid, {}, 1, most);
  keys_.emplace(kernels_->keys(sampled));
  std::vector<SampleSlot> slots(pipeline_slots());
  const auto produce = [&](std::size_t index, std::size_t i) {
    SampleSlot& slot = slots[i];
    slot.distinct.clear();
    if (job.monitor.stopped()) return;
    if (!slot.batch) slot.batch.emplace(*kernels_, *keys_, nothing_known, most, 2);
    sample_batch(job, batches[index], sampled, slot);
  };
  parallel_pipeline(batches.size(), produce, [&](std::size_t index, std::size_t i) {
    SampleSlot& slot = slots[i];
    if (!slot.problem.empty()) job.monitor.fail(slot.problem);
    for (const auto& [key, point] : slot.distinct)
      if (sampled.unique.wants(key)) sampled.unique.insert(key, slot.batch->place(point));
    job.monitor.advance(static_cast<float>(index + 1) / static_cast<float>(batches.size()));
  });
  job.monitor.throw_if_stopped();
  sampled.unique.finish();
  fill_in_vectors(job, sampled);
}

struct DevicePasses::AverageSlot {
  std::optional<PointBatch> batch;
  TileScratch scratch;
  std::string problem;  ///< empty: none
  float residual = 0, outlier_residual = 0;
  std::vector<std::size_t> outlier_texels;
  std::size_t outlier_point = 0;       ///< the worst
  std::vector<std::uint32_t> weighed;  ///< by keys
};

void DevicePasses::average_batch(const BakeJob& job, std::span<const std::size_t> tiles, const Averaging& with,
                                 BaseLevel& base, AverageSlot& slot) {
  PointBatch& batch = *slot.batch;
  slot.scratch.rasterize(job.grid, tiles, with.offsets, with.wanted, batch);
  BakeCall call = with.call;
  call.count = static_cast<std::uint32_t>(with.by_keys ? batch.points() : batch.texels().size());
  if (const auto bad = batch.run(call)) {
    slot.problem = problem_at(job, with.sampled.sampler, batch.point(*bad));
    return;
  }
  if (with.by_keys) slot.weighed = weigh_by_keys(job, with.sampled, with.basis, with.known, batch);
  for (const std::size_t tile : tiles) {
    const TexelRegion region = job.grid.tile(tile);
    for (std::size_t i = 0; i < static_cast<std::size_t>(region.width) * region.height; ++i)
      if (const std::size_t texel = job.grid.texel(region, i); with.wanted[texel]) base.coverage[texel] = 0;
  }
  const std::size_t words = 4 * weight_vectors(base.channels);
  for (std::size_t t = 0; t < batch.texels().size(); ++t) {
    const std::size_t texel = batch.texels()[t];
    const std::uint32_t* out = (with.by_keys ? slot.weighed.data() : batch.out()) + t * words;
    base.coverage[texel] = static_cast<float>(batch.points_of(t)) / static_cast<float>(with.offsets.size());
    std::memcpy(&base.values[texel * base.channels], out + kFirstWeight, base.channels * sizeof(float));
    slot.residual = std::max(slot.residual, std::bit_cast<float>(out[kResidualWord]));
    const float outlier = std::bit_cast<float>(out[kOutlierWord]);
    if (outlier > 0) slot.outlier_texels.push_back(texel);
    if (outlier > slot.outlier_residual) slot.outlier_residual = outlier, slot.outlier_point = out[kOutlierPointWord];
  }
}

ProjectedPoints DevicePasses::average(const BakeJob& job, const SampledTexels& sampled, const ChosenBasis& basis,
                                      const KnownWeights& known, std::span<const std::uint8_t> wanted, int sub_samples,
                                      BaseLevel& base) {
  Averaging with{
      sampled, basis, known, wanted, sub_sample_offsets(sub_samples), sampled.unique.size() <= kFewReflectances, {}};
  with.call.tolerance = job.options.tolerance;
  const std::size_t most = std::max(kernels_->batch_points(), kTile * kTile * with.offsets.size());
  const auto batches = make_batches(job.grid, wanted, with.offsets.size(), most);
  const int size = basis.reflectances.size();
  const DeviceBuffer known_buffer = upload(*kernels_->device(), known_table(known, size, with.call.known_slots));
  if (!with.by_keys && weights_basis_ != basis.scaled) {
    weights_.emplace(kernels_->weights(sampled, basis));
    weights_basis_ = basis.scaled;
  }

  ProjectedPoints projected(sampled.sampler.rows());
  std::vector<AverageSlot> slots(pipeline_slots());
  const auto produce = [&](std::size_t index, std::size_t i) {
    AverageSlot& slot = slots[i];
    slot.residual = slot.outlier_residual = 0, slot.outlier_texels.clear();
    if (job.monitor.stopped()) return;
    if (!slot.batch)
      slot.batch.emplace(*kernels_, with.by_keys ? *keys_ : *weights_, known_buffer, most,
                         with.by_keys ? 2 : 4 * weight_vectors(size));
    average_batch(job, batches[index], with, base, slot);
  };
  parallel_pipeline(batches.size(), produce, [&](std::size_t index, std::size_t i) {
    AverageSlot& slot = slots[i];
    if (!slot.problem.empty()) job.monitor.fail(slot.problem);
    projected.residual = std::max(projected.residual, slot.residual);
    projected.outlier_residual = std::max(projected.outlier_residual, slot.outlier_residual);
    projected.outlier_texels.insert(projected.outlier_texels.end(), slot.outlier_texels.begin(),
                                    slot.outlier_texels.end());
    if (!slot.outlier_texels.empty()) add_outlier(job, sampled, slot.batch->place(slot.outlier_point), projected);
    job.monitor.advance(static_cast<float>(index + 1) / static_cast<float>(batches.size()));
  });
  job.monitor.throw_if_stopped();
  return projected;
}

}  // namespace

std::string reason_to_bake_on_cpu(const Shader& shader, const BakeOptions& options) {
  if (options.selection == BasisSelection::kPaper) return "the paper's selection runs on the CPU";
  if (!shader.info().file.empty() && shader.info().file.extension() != ".glsl") return "plug-ins run on the CPU";
  return "";
}

std::unique_ptr<TexelPasses> make_device_passes(const std::string& device) {
  return std::make_unique<DevicePasses>(device);
}

}  // namespace redmap
