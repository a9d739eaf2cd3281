// Shading by a reduction map (paper, section 5.1, with the lookup and the normals that our design puts in its place).
#include <array>

#include "render/filtered_shading.h"
#include "render/seam_lookup.h"

namespace redmap {

namespace {

class MapShading : public FilteredShading {
 public:
  MapShading(std::shared_ptr<const Shader> shader, std::shared_ptr<const ReductionMap> map,
             std::shared_ptr<const Surface> surface)
      : FilteredShading(shader, map->weights.extent(0)),
        map_(std::move(map)),
        surface_(std::move(surface)),
        basis_(*shader, *map_) {}

 protected:
  void shade_filtered(const ShadingBatch& batch, ShadedBatch& out, RenderCounts& counts) const override {
    auto weights = look_up(batch, counts);
    if (!map_->clusters.empty()) blend_clusters(batch, weights, counts);
    basis_.shade(batch, batch.frames, weights, out, counts);
  }

  Rgb filtered_transmittance(const Footprint& footprint) const override {
    return basis_.transmittance(map_->weights.lookup(footprint, LookupFilter::kVarianceMatched));
  }

 private:
  /// Weights under each footprint: weights[basis][hit].
  std::vector<LaneVector<float>> look_up(const ShadingBatch& batch, RenderCounts& counts) const {
    std::vector<LaneVector<float>> weights(map_->basis.size(), LaneVector<float>(padded(batch.size()), 0.0f));
    const Seams* seams = surface_->seams();
    const auto use = [&](std::size_t i, const FilteredTexel& texel) {
      const Footprint& footprint = batch.footprints[i];
      // Where clusters serve alone there are no seams.
      const bool mend = seams && (map_->clusters.empty() || cluster_part(footprint, base_extent_) < 1);
      const FilteredTexel& whole =
          mend ? mend_at_seams(map_->weights, *seams, batch.hits[i].chart, footprint, texel, counts.lookups) : texel;
      for (std::size_t b = 0; b < weights.size(); ++b) weights[b][i] = whole.channel[b];
    };
    for_each_lookup(map_->weights, batch.footprints, LookupFilter::kVarianceMatched, counts, use);
    return weights;
  }

  /// Far away the surface itself is looked up instead of its atlas: docs/atlas.md.
  void blend_clusters(const ShadingBatch& batch, std::vector<LaneVector<float>>& weights, RenderCounts& counts) const {
    std::array<float, kMaxChannels> mean;
    for (std::size_t i = 0; i < batch.size(); ++i) {
      const Footprint& footprint = batch.footprints[i];
      const float part = cluster_part(footprint, base_extent_);
      if (part <= 0) continue;
      ++counts.lookups;
      const SurfaceHit& hit = batch.hits[i];
      // Clusters are those of the surface at rest, facing outwards: what a pose turned is turned back.
      const Vec3 outward = batch.turned[i] ? -hit.normal : hit.normal;
      const Frame posed = make_frame(outward, hit.tangent), rest = make_frame(hit.rest.normal, hit.rest.tangent);
      const auto on_surface = [&](Vec2 uv) {
        return rest.to_world(posed.to_local(hit.dp_du * uv.x + hit.dp_dv * uv.y));
      };
      const bool found = map_->clusters.lookup(
          {hit.rest.position, hit.rest.normal, on_surface(footprint.duv_dx), on_surface(footprint.duv_dy)}, mean);
      for (std::size_t b = 0; found && b < weights.size(); ++b)
        weights[b][i] = weights[b][i] * (1 - part) + mean[b] * part;
    }
  }

  std::shared_ptr<const ReductionMap> map_;
  std::shared_ptr<const Surface> surface_;
  BasisShading basis_;
};

}  // namespace

std::unique_ptr<ObjectShading> make_map_shading(std::shared_ptr<const Shader> shader,
                                                std::shared_ptr<const ReductionMap> map,
                                                std::shared_ptr<const Surface> surface) {
  return std::make_unique<MapShading>(std::move(shader), std::move(map), std::move(surface));
}

}  // namespace redmap
