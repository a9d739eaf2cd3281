// Shading by a reduction map (paper, section 5.1, with the lookup and the normals that our design puts in its place).
#include <algorithm>
#include <array>

#include "map/lookup_limits.h"
#include "map/tangent_gather.h"
#include "render/basis_shading.h"
#include "render/filtered_shading.h"
#include "render/seam_lookup.h"

namespace redmap {

namespace {

struct Covariance {
  float xx, xy, yy;
};
/// The turning of the interpolated normal within a hit's footprint, a box.
Covariance curvature(const ShadingBatch& batch, std::size_t i) {
  const SurfaceHit& hit = batch.hits[i];
  const Footprint& footprint = batch.footprints[i];
  const Frame& frame = batch.frames[i];
  const auto turned = [&](Vec2 uv) {
    const Vec3 change = hit.dn_du * uv.x + hit.dn_dv * uv.y;
    return Vec2{dot(change, frame.x), dot(change, frame.y)};
  };
  const Vec2 x = turned(footprint.duv_dx), y = turned(footprint.duv_dy);
  const float variance = (dot(x, x) + dot(y, y)) / 12;
  const float scale = std::min(1.0f, kLargestTurn / std::max(variance, 1e-12f)) / 12;
  return {scale * (x.x * x.x + y.x * y.x), scale * (x.x * x.y + y.x * y.y), scale * (x.y * x.y + y.y * y.y)};
}

void add_curvature(const ShadingBatch& batch, NormalMixtures& mixtures) {
  for (std::size_t i = 0; i < batch.size(); ++i) {
    const Covariance c = curvature(batch, i);
    for (std::uint32_t k = mixtures.first[i]; k < mixtures.first[i + 1]; ++k)
      mixtures.xx[k] += c.xx, mixtures.xy[k] += c.xy, mixtures.yy[k] += c.yy;
  }
}

/// Frames of hits from behind have their y and z turned around: so is what was gathered for them.
void face_viewer(const ShadingBatch& batch, NormalMixtures& mixtures) {
  for (std::size_t i = 0; i < batch.size(); ++i) {
    if (!batch.turned[i]) continue;
    for (std::uint32_t k = mixtures.first[i]; k < mixtures.first[i + 1]; ++k)
      mixtures.y[k] = -mixtures.y[k], mixtures.xy[k] = -mixtures.xy[k];
    if (!mixtures.turns.empty())
      for (Vec2& turn : mixtures.turns[i]) turn.y = -turn.y;
  }
}

/// Of a joined hit's footprint, around `uv`.
Footprint quarter(const Footprint& footprint, Vec2 uv) {
  return {uv, footprint.duv_dx * 0.5f, footprint.duv_dy * 0.5f};
}

class MapShading : public FilteredShading {
 public:
  MapShading(std::shared_ptr<const Shader> shader, std::shared_ptr<const ReductionMap> map,
             std::shared_ptr<const Surface> surface)
      : FilteredShading(shader, map->weights.extent(0)),
        map_(std::move(map)),
        surface_(std::move(surface)),
        basis_(*shader, *map_) {}

  /// What passes light goes on ray by ray; and where one of the four would see the shader itself, it shall.
  bool takes_joined(const Footprint& footprint) const override {
    return !transmits() && filtered_part(quarter(footprint, footprint.uv)) >= 1;
  }
  /// Where a highlight changes within the four, one mean normal is not good enough. Maps with normals gather those of
  /// all four.
  bool takes_apart(Decision decision) const override {
    return map_->normals.empty() && (decision == Decision::kConvolved || decision == Decision::kDrawn);
  }

 protected:
  void shade_filtered(const ShadingBatch& batch, ShadedBatch& out, RenderCounts& counts) const override {
    if (!map_->normals.empty()) return shade_normals(batch, out, counts);
    auto weights = look_up(batch, counts);
    if (!map_->clusters.empty()) blend_clusters(batch, weights, counts);
    NormalMixtures mixtures = NormalMixtures::one_each(batch.size(), std::move(weights));
    gather_turns(batch, mixtures, counts);
    face_viewer(batch, mixtures);
    add_curvature(batch, mixtures);
    basis_.shade_around(batch, mixtures, out, counts);
  }

  Rgb filtered_transmittance(const Footprint& footprint) const override {
    return basis_.transmittance(map_->weights.lookup(footprint, LookupFilter::kVarianceMatched));
  }

 private:
  void gather_turns(const ShadingBatch& batch, NormalMixtures& mixtures, RenderCounts& counts) const {
    if (map_->tangents.empty()) return;
    mixtures.turns.resize(batch.size());
    redmap::gather_turns(map_->tangents, batch.footprints, mixtures.turns);
    counts.lookups += batch.size();
  }

  /// Weights under each footprint: weights[basis][hit]. Joined hits are looked up each by itself: the mean of four
  /// narrow lookups is nearer to a box than one wide lookup is, and costs little beside shading.
  std::vector<LaneVector<float>> look_up(const ShadingBatch& batch, RenderCounts& counts) const {
    if (batch.parts.empty()) return look_up(batch, batch.footprints, 1, counts);
    std::vector<Footprint> footprints;
    footprints.reserve(kJoined * batch.size());
    for (std::size_t i = 0; i < batch.size(); ++i)
      for (const Vec2 uv : batch.parts[i]) footprints.push_back(quarter(batch.footprints[i], uv));
    return look_up(batch, footprints, kJoined, counts);
  }

  /// The mean over `each` footprints a hit, one after the other.
  std::vector<LaneVector<float>> look_up(const ShadingBatch& batch, std::span<const Footprint> footprints,
                                         std::size_t each, RenderCounts& counts) const {
    std::vector<LaneVector<float>> weights(map_->basis.size(), LaneVector<float>(padded(batch.size()), 0.0f));
    const Seams* seams = surface_->seams();
    const float part = 1 / static_cast<float>(each);
    const auto use = [&](std::size_t k, const FilteredTexel& texel) {
      const std::size_t i = k / each;
      const Footprint& footprint = footprints[k];
      // Where clusters serve alone there are no seams.
      const bool mend = seams && (map_->clusters.empty() || cluster_part(footprint, base_extent_) < 1);
      const FilteredTexel& whole =
          mend ? mend_at_seams(map_->weights, *seams, batch.hits[i].chart, footprint, texel, counts.lookups) : texel;
      for (std::size_t b = 0; b < weights.size(); ++b) weights[b][i] += part * whole.channel[b];
    };
    for_each_lookup(map_->weights, footprints, LookupFilter::kVarianceMatched, counts, use);
    return weights;
  }

  void shade_normals(const ShadingBatch& batch, ShadedBatch& out, RenderCounts& counts) const {
    NormalMixtures mixtures = NormalMixtures::none(map_->basis.size());
    map_->normals.gather(batch.footprints, map_->weights, kGatheredTexels, mixtures);
    counts.lookups += batch.size();
    gather_turns(batch, mixtures, counts);
    face_viewer(batch, mixtures);
    add_curvature(batch, mixtures);
    basis_.integrate(batch, mixtures, out, counts);
  }

  /// Far away the surface itself is looked up instead of its atlas: docs/atlas.md.
  void blend_clusters(const ShadingBatch& batch, std::vector<LaneVector<float>>& weights, RenderCounts& counts) const {
    std::array<float, kMaxChannels> mean;
    for (std::size_t i = 0; i < batch.size(); ++i) {
      const Footprint& footprint = batch.footprints[i];
      const float part = cluster_part(batch.parts.empty() ? footprint : quarter(footprint, footprint.uv), base_extent_);
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
