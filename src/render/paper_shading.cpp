// The paper's own rendering (sections 5.1 to 5.3), kept to the letter for comparison.
#include <algorithm>
#include <cmath>

#include "map/normal_moments.h"
#include "render/basis_shading.h"
#include "render/filtered_shading.h"

namespace redmap {

namespace {

// Section 5.2: a half vector within so many standard deviations of the mean normal, and its highlight may be seen.
constexpr float kHighlightDeviations = 2.5f;

class PaperShading : public FilteredShading {
 public:
  PaperShading(std::shared_ptr<const Shader> shader, std::shared_ptr<const ReductionMap> map,
               std::shared_ptr<const Pyramid<float>> normals)
      : FilteredShading(shader, map->weights.extent(0)),
        map_(std::move(map)),
        normals_(std::move(normals)),
        has_distributions_(normals_->channels() == NormalMoments::kCount),
        basis_(*shader, *map_) {}

 protected:
  /// "Nearly the same" as a texel is not quantified in the paper: we blend by area over one to two texels.
  float filtered_part(const Footprint& footprint) const override {
    const float area = std::abs(cross(footprint.duv_dx, footprint.duv_dy)) * static_cast<float>(base_extent_.width) *
                       static_cast<float>(base_extent_.height);
    return std::clamp(area - 1, 0.0f, 1.0f);
  }

  void shade_filtered(const ShadingBatch& batch, ShadedBatch& out, RenderCounts& counts) const override {
    // The stored mean normal takes the place of the hit's.
    std::vector<Frame> frames(batch.size());
    std::vector<std::uint32_t> by_mean, by_samples;
    const auto use = [&](std::size_t i, const FilteredTexel& texel) {
      const float side = batch.turned[i] ? -1.0f : 1.0f;
      const Vec3 mean = Vec3{texel.channel[0], texel.channel[1], texel.channel[2]} * side;
      frames[i] = make_frame(normalized(mean), batch.hits[i].tangent);
      const bool highlight = has_distributions_ && sees_highlight(batch, i, texel.channel.data(), side);
      (highlight ? by_samples : by_mean).push_back(static_cast<std::uint32_t>(i));
    };
    for_each_lookup(*normals_, batch.footprints, LookupFilter::kEnclosingSquare, counts, use);
    if (by_samples.empty()) return shade_mean(batch, frames, out, counts);

    out.radiance = Planes<3>(batch.size());
    out.transmittance = Planes<3>(batch.size());
    ShadedBatch shaded;
    if (!by_mean.empty()) {
      std::vector<Frame> mean_frames;
      for (std::uint32_t i : by_mean) mean_frames.push_back(frames[i]);
      shade_mean(select(batch, by_mean), mean_frames, shaded, counts);
      scatter(shaded, by_mean, out);
    }
    for (std::uint32_t i : by_samples)
      out.decisions[i] = batch.may_defer ? Decision::kSupersampled : Decision::kOriginal;
    if (batch.may_defer) return;
    // One of the rays that a pixel has been subdivided into.
    original().shade(select(batch, by_samples), shaded, counts);
    scatter(shaded, by_samples, out);
  }

  Rgb filtered_transmittance(const Footprint& footprint) const override {
    return basis_.transmittance(map_->weights.lookup(footprint, LookupFilter::kEnclosingSquare));
  }

 private:
  /// Whether the half vector of any light that reaches hit `i` belongs to the distribution of normals under it.
  static bool sees_highlight(const ShadingBatch& batch, std::size_t i, const float* moments, float side) {
    for (const ShadingBatch::Light& light : batch.lights) {
      const Vec3 e = light.irradiance.get(i);
      if (e.x + e.y + e.z <= 0) continue;
      const Vec3 half_vector = normalized(light.to_light[i] + batch.to_viewer[i]) * side;
      if (squared_deviations(moments, half_vector) <= kHighlightDeviations * kHighlightDeviations) return true;
    }
    return false;
  }

  void shade_mean(const ShadingBatch& batch, std::span<const Frame> frames, ShadedBatch& out,
                  RenderCounts& counts) const {
    const auto weights = lookup_weights(*map_, batch.footprints, LookupFilter::kEnclosingSquare, counts);
    basis_.shade(batch, frames, weights, out, counts);
  }

  std::shared_ptr<const ReductionMap> map_;
  std::shared_ptr<const Pyramid<float>> normals_;
  bool has_distributions_;
  BasisShading basis_;
};

}  // namespace

std::unique_ptr<ObjectShading> make_paper_shading(std::shared_ptr<const Shader> shader,
                                                  std::shared_ptr<const ReductionMap> map,
                                                  std::shared_ptr<const Pyramid<float>> normals) {
  return std::make_unique<PaperShading>(std::move(shader), std::move(map), std::move(normals));
}

}  // namespace redmap
