#include "verify/weighted_shading.h"

#include <algorithm>
#include <utility>

#include "shader/shading_frames.h"

namespace redmap {

namespace {

std::vector<LaneVector<float>> no_weights(std::size_t basis, std::size_t hits) {
  return std::vector<LaneVector<float>>(basis, LaneVector<float>(padded(hits), 0.0f));
}

class WeightedShading : public ObjectShading {
 public:
  WeightedShading(std::shared_ptr<const Shader> shader, std::shared_ptr<const BasisShading> basis, WeightSource weights)
      : shader_(std::move(shader)), basis_(std::move(basis)), weights_(std::move(weights)) {}

  void shade(const ShadingBatch& batch, ShadedBatch& out, RenderCounts& counts) const override {
    const ShaderInfo& info = shader_->info();
    const bool ask = weights_.asks_shader || info.perturbs_normals || info.turns_tangents;
    const auto patterns = ask ? shader_->bind(surface_points(batch)) : nullptr;
    out.decisions.assign(batch.size(), Decision::kMeanNormal);
    basis_->shade(batch, patterns ? shading_frames(batch, *patterns) : batch.frames, weights_.at(batch, patterns.get()),
                  out, counts);
  }
  bool needs_footprints() const override { return false; }
  /// Shadows are the truth's: they are no stage of a map.
  void transmittance(std::span<const SurfaceHit> hits, std::span<const Footprint> footprints, float time,
                     Planes<3>& out) const override {
    make_shader_shading(shader_)->transmittance(hits, footprints, time, out);
  }

 private:
  std::shared_ptr<const Shader> shader_;
  std::shared_ptr<const BasisShading> basis_;
  WeightSource weights_;
};

}  // namespace

std::unique_ptr<ObjectShading> make_weighted_shading(std::shared_ptr<const Shader> shader,
                                                     std::shared_ptr<const BasisShading> basis, WeightSource weights) {
  return std::make_unique<WeightedShading>(std::move(shader), std::move(basis), std::move(weights));
}

WeightSource projected_weights(const Shader& shader, const ReductionMap& map, std::vector<float> scales) {
  const ReflectanceSampler sampler(shader.info());
  SampledReflectances places;
  sampler.sample(*bind_in_frames(shader, basis_points(map), basis_frames(map)), places);
  ReflectanceBasis basis(sampler.rows());
  std::vector<float> scaled(sampler.rows());
  for (std::size_t b = 0; b < map.basis.size(); ++b) {
    scaled_reflectance(places, b, scales, scaled.data());
    basis.add(scaled.data());
  }
  const auto fit = [sampler, basis, scales = std::move(scales)](const ShadingBatch& batch,
                                                                const BoundPatterns* patterns) {
    auto weights = no_weights(basis.size(), batch.size());
    SampledReflectances sampled;
    sampler.sample(*patterns, sampled);
    std::vector<float> reflectance(sampler.rows());
    BasisWeights fitted;
    for (std::size_t i = 0; i < batch.size(); ++i) {
      scaled_reflectance(sampled, i, scales, reflectance.data());
      basis.fit(reflectance.data(), fitted);
      for (std::size_t b = 0; b < weights.size(); ++b) weights[b][i] = fitted[b];
    }
    return weights;
  };
  return {fit, true};
}

WeightSource texel_weights(std::shared_ptr<const ReductionMap> map) {
  const auto look = [map = std::move(map)](const ShadingBatch& batch, const BoundPatterns*) {
    auto weights = no_weights(map->basis.size(), batch.size());
    const Extent extent = map->weights.extent(0);
    const auto texel_at = [](float coordinate, int texels) {
      return std::clamp(static_cast<int>(coordinate * static_cast<float>(texels)), 0, texels - 1);
    };
    for (std::size_t i = 0; i < batch.size(); ++i) {
      const int x = texel_at(batch.hits[i].uv.x, extent.width), y = texel_at(batch.hits[i].uv.y, extent.height);
      for (std::size_t b = 0; b < weights.size(); ++b) weights[b][i] = map->weights.value(0, x, y, static_cast<int>(b));
    }
    return weights;
  };
  return {look};
}

WeightSource constant_weights(std::vector<float> weights) {
  const auto repeat = [weights = std::move(weights)](const ShadingBatch& batch, const BoundPatterns*) {
    auto same = no_weights(weights.size(), batch.size());
    for (std::size_t b = 0; b < same.size(); ++b) std::fill_n(same[b].begin(), batch.size(), weights[b]);
    return same;
  };
  return {repeat};
}

}  // namespace redmap
