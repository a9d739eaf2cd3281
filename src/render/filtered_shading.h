// Shading by something filtered far away and by the shader itself close up, with a blend between.
#pragma once

#include <algorithm>
#include <array>

#include "render/shading.h"

namespace redmap {

class FilteredShading : public ObjectShading {
 public:
  FilteredShading(std::shared_ptr<const Shader> shader, Extent base_extent)
      : base_extent_(base_extent),
        transmits_(shader->info().transmits),
        original_(make_shader_shading(std::move(shader))) {}

  void shade(const ShadingBatch& batch, ShadedBatch& out, RenderCounts& counts) const final;
  bool needs_footprints() const final { return true; }
  void transmittance(std::span<const SurfaceHit> hits, std::span<const Footprint> footprints, float time,
                     Planes<3>& out) const final;

 protected:
  /// Part of the filtered value, 0 (the shader itself) to 1, by the sample's footprint.
  virtual float filtered_part(const Footprint& footprint) const;
  /// `out.decisions` come as kMeanNormal, for as many hits.
  virtual void shade_filtered(const ShadingBatch& batch, ShadedBatch& out, RenderCounts& counts) const = 0;
  virtual Rgb filtered_transmittance(const Footprint& footprint) const = 0;
  const ObjectShading& original() const { return *original_; }
  bool transmits() const { return transmits_; }
  Extent base_extent_;

 private:
  bool transmits_;
  std::unique_ptr<ObjectShading> original_;
};

/// Calls use(i, filtered texel) for every footprint, looked up in batches.
template <typename Component, typename Use>
void for_each_lookup(const Pyramid<Component>& pyramid, std::span<const Footprint> footprints, LookupFilter filter,
                     RenderCounts& counts, const Use& use) {
  std::array<FilteredTexel, kLookupBatch> texels;
  for (std::size_t first = 0; first < footprints.size(); first += kLookupBatch) {
    const std::size_t count = std::min(kLookupBatch, footprints.size() - first);
    pyramid.lookup(footprints.subspan(first, count), filter, {texels.data(), count});
    for (std::size_t i = 0; i < count; ++i) use(first + i, texels[i]);
  }
  counts.lookups += footprints.size();
}

/// Looks every footprint up: weights[basis][hit], padded with zeros.
std::vector<LaneVector<float>> lookup_weights(const ReductionMap& map, std::span<const Footprint> footprints,
                                              LookupFilter filter, RenderCounts& counts);

}  // namespace redmap
