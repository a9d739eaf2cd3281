// The paper's own rendering (sections 5.1 and 5.3), kept to the letter for comparison.
#include <algorithm>
#include <cmath>

#include "render/filtered_shading.h"

namespace redmap {

namespace {

class PaperShading : public FilteredShading {
 public:
  PaperShading(std::shared_ptr<const Shader> shader, std::shared_ptr<const ReductionMap> map,
               std::shared_ptr<const Pyramid<float>> normals)
      : FilteredShading(shader, map->weights.extent(0)),
        map_(std::move(map)),
        normals_(std::move(normals)),
        basis_(*shader, *map_) {}

 protected:
  /// "Nearly the same" as a texel is not quantified in the paper: we blend by area over one to two texels.
  float filtered_part(const Footprint& footprint) const override {
    const float area = std::abs(cross(footprint.duv_dx, footprint.duv_dy)) * static_cast<float>(base_extent_.width) *
                       static_cast<float>(base_extent_.height);
    return std::clamp(area - 1, 0.0f, 1.0f);
  }

  void shade_filtered(const ShadingBatch& batch, ShadedBatch& out, RenderCounts& counts) const override {
    const auto weights = lookup_weights(*map_, batch.footprints, LookupFilter::kEnclosingSquare, counts);
    // The stored mean normal takes the place of the hit's.
    std::vector<Frame> frames(batch.size());
    const auto use_mean = [&](std::size_t i, const FilteredTexel& texel) {
      const Vec3 mean = normalized({texel.channel[0], texel.channel[1], texel.channel[2]});
      frames[i] = make_frame(batch.turned[i] ? -mean : mean, batch.hits[i].tangent);
    };
    for_each_lookup(*normals_, batch.footprints, LookupFilter::kEnclosingSquare, counts, use_mean);
    basis_.shade(batch, frames, weights, out, counts);
  }

  Rgb filtered_transmittance(const Footprint& footprint) const override {
    return basis_.transmittance(map_->weights.lookup(footprint, LookupFilter::kEnclosingSquare));
  }

 private:
  std::shared_ptr<const ReductionMap> map_;
  std::shared_ptr<const Pyramid<float>> normals_;
  BasisShading basis_;
};

}  // namespace

std::unique_ptr<ObjectShading> make_paper_shading(std::shared_ptr<const Shader> shader,
                                                  std::shared_ptr<const ReductionMap> map,
                                                  std::shared_ptr<const Pyramid<float>> normals) {
  return std::make_unique<PaperShading>(std::move(shader), std::move(map), std::move(normals));
}

}  // namespace redmap
