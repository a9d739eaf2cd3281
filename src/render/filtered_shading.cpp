#include "render/filtered_shading.h"
#include "map/lookup_limits.h"

#include <algorithm>

namespace redmap {

namespace {

void blend_into(Planes<3>& out, std::size_t i, Vec3 value, float part) {
  out.set(i, part >= 1 ? value : out.get(i) * (1 - part) + value * part);
}

}  // namespace

float FilteredShading::filtered_part(const Footprint& footprint) const {
  const float width = static_cast<float>(base_extent_.width), height = static_cast<float>(base_extent_.height);
  const Vec2 x{footprint.duv_dx.x * width, footprint.duv_dx.y * height};
  const Vec2 y{footprint.duv_dy.x * width, footprint.duv_dy.y * height};
  // The major axis lies between the longer side and the root of the sides' squares: most footprints are decided there.
  if (std::max(dot(x, x), dot(y, y)) >= kBlendEnd * kBlendEnd) return 1;
  if (dot(x, x) + dot(y, y) <= kBlendBegin * kBlendBegin) return 0;
  const float major = footprint_axes(footprint, base_extent_).major;
  return std::clamp((major - kBlendBegin) / (kBlendEnd - kBlendBegin), 0.0f, 1.0f);
}

void FilteredShading::shade(const ShadingBatch& batch, ShadedBatch& out, RenderCounts& counts) const {
  std::vector<float> part(batch.size());
  std::vector<std::uint32_t> near_hits, far_hits;
  for (std::uint32_t i = 0; i < batch.size(); ++i) {
    part[i] = filtered_part(batch.footprints[i]);
    if (part[i] < 1) near_hits.push_back(i);
    if (part[i] > 0) far_hits.push_back(i);
  }
  out.decisions.assign(batch.size(), Decision::kMeanNormal);
  if (near_hits.empty()) return shade_filtered(batch, out, counts);
  if (far_hits.empty()) return original_->shade(batch, out, counts);

  out.radiance.resize(batch.size());
  out.transmittance.resize(batch.size());
  ShadedBatch shaded;
  original_->shade(select(batch, near_hits), shaded, counts);
  scatter(shaded, near_hits, out);
  for (std::uint32_t i : near_hits) out.decisions[i] = part[i] > 0 ? Decision::kBlended : Decision::kOriginal;
  shaded.decisions.assign(far_hits.size(), Decision::kMeanNormal);
  shade_filtered(select(batch, far_hits), shaded, counts);
  for (std::size_t i = 0; i < far_hits.size(); ++i) {
    Decision& decision = out.decisions[far_hits[i]];
    decision = std::max(decision, shaded.decisions[i]);
    blend_into(out.radiance, far_hits[i], shaded.radiance.get(i), part[far_hits[i]]);
    blend_into(out.transmittance, far_hits[i], shaded.transmittance.get(i), part[far_hits[i]]);
  }
}

void FilteredShading::transmittance(std::span<const SurfaceHit> hits, std::span<const Footprint> footprints, float time,
                                    Planes<3>& out) const {
  out = Planes<3>(hits.size());
  if (!transmits_) return;
  std::vector<std::uint32_t> near_hits;
  std::vector<SurfaceHit> near_surface;
  for (std::uint32_t i = 0; i < hits.size(); ++i) {
    const float part = filtered_part(footprints[i]);
    if (part < 1) near_hits.push_back(i), near_surface.push_back(hits[i]);
    if (part == 0) continue;
    const Rgb t = filtered_transmittance(footprints[i]);
    out.set(i, Vec3{t.r, t.g, t.b});
  }
  if (near_hits.empty()) return;
  Planes<3> original;
  original_->transmittance(near_surface, {}, time, original);
  for (std::size_t k = 0; k < near_hits.size(); ++k) {
    const float part = filtered_part(footprints[near_hits[k]]);
    const Vec3 filtered = out.get(near_hits[k]);
    out.set(near_hits[k], original.get(k));
    if (part > 0) blend_into(out, near_hits[k], filtered, part);
  }
}

std::vector<LaneVector<float>> lookup_weights(const ReductionMap& map, std::span<const Footprint> footprints,
                                              LookupFilter filter, RenderCounts& counts) {
  const std::size_t basis = map.basis.size();
  std::vector<LaneVector<float>> weights(basis, LaneVector<float>(padded(footprints.size()), 0.0f));
  for_each_lookup(map.weights, footprints, filter, counts, [&](std::size_t i, const FilteredTexel& texel) {
    for (std::size_t b = 0; b < basis; ++b) weights[b][i] = texel.channel[b];
  });
  return weights;
}

}  // namespace redmap
