#include "bake/project.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <unordered_map>

#include "base/parallel.h"

namespace redmap {
namespace {

/// Neighbours differ, and are worth sub-samples, when their mixtures do by this many tolerances: a centre sample of a
/// smooth pattern is exact to second order, so a gradient may be larger than the error allowed (docs/bake.md).
constexpr float kDifference = 4;

/// Outliers that are kept to choose from.
constexpr std::size_t kMaxOutliers = 1024;

void append(ChosenBasis& basis, const float* scaled, int rows, const ReflectancePlace& place) {
  basis.reflectances.add(scaled);
  basis.scaled.insert(basis.scaled.end(), scaled, scaled + rows);
  basis.places.push_back(place);
}

/// Weights of every covered texel's centre. Returns which texels have a reflectance that was not kept.
std::vector<std::uint8_t> fill_from_ids(const SampledTexels& sampled, const KnownWeights& known, BaseLevel& base) {
  std::vector<std::uint8_t> unknown(sampled.id.size());
  const std::size_t width = base.extent.width;
  parallel_for(base.extent.height, [&](std::size_t y) {
    std::uint32_t last_id = 0, last = 0;
    for (std::size_t t = y * width; t < (y + 1) * width; ++t) {
      const std::uint32_t id = sampled.id[t];
      if (id == 0) continue;
      base.coverage[t] = 1;
      if (id != last_id) {
        const auto found = known.of_id.find(id);
        if (found == known.of_id.end()) {
          unknown[t] = 1;
          continue;
        }
        last_id = id, last = found->second;
      }
      std::copy_n(known.weights[last].begin(), base.channels, &base.values[t * base.channels]);
    }
  });
  return unknown;
}

/// Projects points in batches and remembers those that the basis does not represent.
class PointProjection {
 public:
  PointProjection(const BakeJob& job, const SampledTexels& sampled, const KnownWeights& known, const ChosenBasis& basis)
      : job_(job),
        sampled_(sampled),
        known_(known),
        basis_(basis),
        slots_(pipeline_slots()),
        projected_(sampled.sampler.rows()) {}

  void evaluate(const SurfacePoints& points, std::span<const std::size_t> texel, std::size_t slot, float* out);
  void tile_done(std::size_t slot);

  ProjectedPoints take() { return std::move(projected_); }

 private:
  struct Fit {
    BasisWeights weights;
    float residual;
  };
  struct Slot {
    SampledReflectances sampled;
    std::vector<std::uint64_t> keys;
    LaneVector<float> sums;
    std::vector<float> scaled;
    std::unordered_map<std::uint64_t, Fit> fits;  ///< of one batch: what is reused must not depend on the threads
    float residual = 0, outlier_residual = 0;
    std::string problem;  ///< empty: none
    // The tile's outliers: their texels, and the worst of them.
    std::vector<std::size_t> outlier_texels;
    std::vector<float> outlier_scaled;
    std::uint64_t outlier_key = 0;
    ReflectancePlace outlier_place;
  };
  Fit fit(Slot& slot, std::size_t place, const SurfacePoints& points);

  const BakeJob& job_;
  const SampledTexels& sampled_;
  const KnownWeights& known_;
  const ChosenBasis& basis_;
  std::vector<Slot> slots_;
  ProjectedPoints projected_;
};

PointProjection::Fit PointProjection::fit(Slot& slot, std::size_t place, const SurfacePoints& points) {
  const std::uint64_t key = slot.keys[place];
  if (const auto found = known_.of_key.find(key); found != known_.of_key.end())
    return {known_.weights[found->second], known_.residuals[found->second]};
  if (const auto found = slot.fits.find(key); found != slot.fits.end()) return found->second;
  slot.scaled.resize(slot.sampled.rows);
  scaled_reflectance(slot.sampled, place, sampled_.row_scales, slot.scaled.data());
  Fit fit;
  fit.residual = basis_.reflectances.fit(slot.scaled.data(), fit.weights);
  if (fit.residual > job_.options.tolerance && fit.residual > slot.outlier_residual) {
    slot.outlier_scaled = slot.scaled;
    slot.outlier_key = key;
    slot.outlier_place = {points.position.get(place),
                          points.normal.get(place),
                          points.tangent.get(place),
                          {points.uv[0][place], points.uv[1][place]}};
  }
  slot.fits.emplace(key, fit);
  return fit;
}

void PointProjection::evaluate(const SurfacePoints& points, std::span<const std::size_t> texel, std::size_t index,
                               float* out) {
  Slot& slot = slots_[index];
  sampled_.sampler.sample(*job_.shader.bind(points), slot.sampled);
  const int channels = basis_.reflectances.size();
  if (const std::string problem = find_problem(job_.shader, points, slot.sampled); !problem.empty()) {
    if (slot.problem.empty()) slot.problem = problem;
    std::fill_n(out, points.size() * channels, 0.0f);
    return;
  }
  sampled_.keys.compute(slot.sampled, slot.keys, slot.sums);
  slot.fits.clear();
  Fit current;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (i == 0 || slot.keys[i] != slot.keys[i - 1]) current = fit(slot, i, points);
    std::copy_n(current.weights.begin(), channels, out + i * channels);
    if (current.residual <= job_.options.tolerance) {
      slot.residual = std::max(slot.residual, current.residual);
    } else {
      slot.outlier_residual = std::max(slot.outlier_residual, current.residual);
      if (slot.outlier_texels.empty() || slot.outlier_texels.back() != texel[i])
        slot.outlier_texels.push_back(texel[i]);
    }
  }
}

void PointProjection::tile_done(std::size_t index) {
  Slot& slot = slots_[index];
  if (!slot.problem.empty()) job_.monitor.fail(slot.problem);
  projected_.residual = std::max(projected_.residual, slot.residual);
  projected_.outlier_residual = std::max(projected_.outlier_residual, slot.outlier_residual);
  if (!slot.outlier_scaled.empty())
    projected_.outliers.insert(slot.outlier_key, slot.outlier_scaled.data(), slot.outlier_place);
  projected_.outlier_texels.insert(projected_.outlier_texels.end(), slot.outlier_texels.begin(),
                                   slot.outlier_texels.end());
  slot.residual = slot.outlier_residual = 0;
  slot.outlier_scaled.clear(), slot.outlier_texels.clear();
}

/// More channels, zero for what is there already: a larger basis leaves weights that were good enough as they are.
void widen(BaseLevel& base, int channels) {
  BaseLevel wide(base.extent, channels, base.wraps_u);
  for (std::size_t t = 0; t < base.coverage.size(); ++t)
    std::copy_n(&base.values[t * base.channels], base.channels, &wide.values[t * channels]);
  wide.coverage.swap(base.coverage);
  base = std::move(wide);
}

/// Adds outliers to the basis until all are represented or it is full.
void extend_basis(UniqueReflectances& outliers, const BakeOptions& options, ChosenBasis& basis) {
  outliers.finish();
  const int rows = outliers.rows();
  std::vector<float> vectors = basis.scaled;
  for (std::size_t i = 0; i < outliers.size(); ++i)
    vectors.insert(vectors.end(), outliers.scaled(i), outliers.scaled(i) + rows);
  std::vector<std::size_t> start(basis.places.size());
  std::iota(start.begin(), start.end(), 0u);
  const BasisChoice choice = choose_basis({vectors, rows}, options.tolerance, options.max_basis, start);
  for (std::size_t i = start.size(); i < choice.chosen.size(); ++i) {
    const std::size_t outlier = choice.chosen[i] - start.size();
    append(basis, outliers.scaled(outlier), rows, outliers.place(outlier));
    ++basis.outliers;
  }
}

std::vector<std::uint8_t> mask_of(const std::vector<std::size_t>& texels, std::size_t count) {
  std::vector<std::uint8_t> mask(count);
  for (std::size_t t : texels) mask[t] = 1;
  return mask;
}

/// Averages the `wanted` texels; what the basis does not represent extends it, and only those texels are done again.
void average_and_extend(const BakeJob& job, TexelPasses& passes, const SampledTexels& sampled,
                        std::vector<std::uint8_t> wanted, int sub_samples, ChosenBasis& basis, BaseLevel& base) {
  for (;;) {
    const KnownWeights known(sampled.unique, basis.reflectances);
    ProjectedPoints projected = passes.average(job, sampled, basis, known, wanted, sub_samples, base);
    basis.residual = std::max(basis.residual, projected.residual);
    if (projected.outlier_texels.empty()) return;
    const int before = basis.reflectances.size();
    if (before < job.options.max_basis) extend_basis(projected.outliers, job.options, basis);
    if (basis.reflectances.size() == before) {
      basis.residual = std::max(basis.residual, projected.outlier_residual);
      return;
    }
    widen(base, basis.reflectances.size());
    wanted = mask_of(projected.outlier_texels, job.grid.texels());
  }
}

}  // namespace

ChosenBasis choose(const SampledTexels& sampled, const BakeOptions& options) {
  const UniqueReflectances& unique = sampled.unique;
  std::vector<float> vectors;
  vectors.reserve(unique.size() * unique.rows());
  for (std::size_t i = 0; i < unique.size(); ++i)
    vectors.insert(vectors.end(), unique.scaled(i), unique.scaled(i) + unique.rows());
  const BasisChoice choice = choose_basis({vectors, unique.rows()}, options.tolerance, options.max_basis);
  ChosenBasis basis{ReflectanceBasis(unique.rows()), {}, {}, choice.residual, 0};
  for (std::size_t i : choice.chosen) append(basis, unique.scaled(i), unique.rows(), unique.place(i));
  return basis;
}

KnownWeights::KnownWeights(const UniqueReflectances& unique, const ReflectanceBasis& basis)
    : weights(unique.size()), residuals(unique.size()) {
  parallel_for(unique.size(), [&](std::size_t i) { residuals[i] = basis.fit(unique.scaled(i), weights[i]); });
  for (std::uint32_t i = 0; i < unique.size(); ++i)
    of_key.emplace(unique.key(i), i), of_id.emplace(texel_id(unique.key(i)), i);
}

ProjectedPoints::ProjectedPoints(int rows) : outliers(rows, kMaxOutliers) {}

ProjectedPoints average_on_cpu(const BakeJob& job, const SampledTexels& sampled, const ChosenBasis& basis,
                               const KnownWeights& known, std::span<const std::uint8_t> wanted, int sub_samples,
                               BaseLevel& base) {
  PointProjection projection(job, sampled, known, basis);
  average_texels(
      job.grid, wanted, sub_samples,
      [&](const SurfacePoints& points, std::span<const std::size_t> texel, std::size_t slot, float* out) {
        projection.evaluate(points, texel, slot, out);
      },
      [&](std::size_t slot) { projection.tile_done(slot); }, job.monitor, base);
  return projection.take();
}

BaseLevel project(const BakeJob& job, TexelPasses& passes, SampledTexels& sampled, ChosenBasis& basis,
                  BakeReport& report) {
  const TexelGrid& grid = job.grid;
  BaseLevel base(grid.extent(), basis.reflectances.size(), grid.surface().wraps_u());
  std::vector<std::uint8_t> unknown = fill_from_ids(sampled, KnownWeights(sampled.unique, basis.reflectances), base);
  report.covered_texels = grid.texels() - std::count(sampled.id.begin(), sampled.id.end(), 0u);
  std::vector<std::uint32_t>().swap(sampled.id);

  // Reflectances that were not kept are sampled once more; then all texels have weights to compare.
  job.monitor.begin("project", 0.55f);
  if (std::find(unknown.begin(), unknown.end(), 1) != unknown.end())
    average_and_extend(job, passes, sampled, std::move(unknown), 1, basis, base);

  // Where the shader does not reduce, sub-samples would only make a wrong map smoother.
  job.monitor.begin("refine", 0.95f);
  if (basis.residual > job.options.tolerance || job.options.sub_samples == 1) return base;
  const float difference = kDifference * job.options.tolerance;
  std::vector<std::uint8_t> differing = find_differing_texels(
      base, [&](const float* a, const float* b) { return basis.reflectances.distance(a, b) > difference; });
  report.refined_texels = std::count(differing.begin(), differing.end(), 1);
  average_and_extend(job, passes, sampled, std::move(differing), job.options.sub_samples, basis, base);
  return base;
}

}  // namespace redmap
