// Shading by a reduction map (paper, section 5.1, with the lookup and the normals that our design puts in its place).
#include "render/filtered_shading.h"

namespace redmap {

namespace {

class MapShading : public FilteredShading {
 public:
  MapShading(std::shared_ptr<const Shader> shader, std::shared_ptr<const ReductionMap> map)
      : FilteredShading(shader, map->weights.extent(0)), map_(std::move(map)), basis_(*shader, *map_) {}

 protected:
  void shade_filtered(const ShadingBatch& batch, ShadedBatch& out, RenderCounts& counts) const override {
    const auto weights = lookup_weights(*map_, batch.footprints, LookupFilter::kVarianceMatched, counts);
    basis_.shade(batch, batch.frames, weights, out, counts);
  }

  Rgb filtered_transmittance(const Footprint& footprint) const override {
    return basis_.transmittance(map_->weights.lookup(footprint, LookupFilter::kVarianceMatched));
  }

 private:
  std::shared_ptr<const ReductionMap> map_;
  BasisShading basis_;
};

}  // namespace

std::unique_ptr<ObjectShading> make_map_shading(std::shared_ptr<const Shader> shader,
                                                std::shared_ptr<const ReductionMap> map) {
  return std::make_unique<MapShading>(std::move(shader), std::move(map));
}

}  // namespace redmap
