// Going straight over a seam one is in another chart: the pieces of the footprint are looked up where they come to lie.
#include "render/seam_lookup.h"
#include "map/lookup_limits.h"

#include <array>
#include <span>
#include <vector>

namespace redmap {

namespace {

/// Piece (i, j) of a footprint, beyond the seam where the straight way there from the centre crosses one of `edges`.
Footprint piece(const Footprint& f, std::span<const SeamEdge> edges, int i, int j) {
  constexpr float kPart = 1.0f / kSeamPieces;
  const auto centre = [](int k) { return (static_cast<float>(k) + 0.5f) * kPart - 0.5f; };
  const Vec2 way = f.duv_dx * centre(i) + f.duv_dy * centre(j);
  const Footprint here{f.uv + way, f.duv_dx * kPart, f.duv_dy * kPart};
  const SeamEdge* edge = first_crossed(edges, f.uv, way);
  if (!edge) return here;
  return {edge->beyond(here.uv), edge->direction_beyond(here.duv_dx), edge->direction_beyond(here.duv_dy)};
}

/// The mean, weighted by coverage; `otherwise` if nothing is covered.
FilteredTexel mean(std::span<const FilteredTexel> texels, const FilteredTexel& otherwise) {
  FilteredTexel sum;
  for (const FilteredTexel& texel : texels) {
    sum.coverage += texel.coverage;
    for (std::size_t c = 0; c < sum.channel.size(); ++c) sum.channel[c] += texel.coverage * texel.channel[c];
  }
  if (!(sum.coverage > 0)) return otherwise;
  for (float& value : sum.channel) value /= sum.coverage;
  sum.coverage /= static_cast<float>(texels.size());
  return sum;
}

}  // namespace

FilteredTexel mend_at_seams(const WeightPyramid& weights, const Seams& seams, std::uint32_t chart,
                            const Footprint& footprint, const FilteredTexel& texel, std::uint64_t& lookups) {
  const float reach = 0.5f * (length(footprint.duv_dx) + length(footprint.duv_dy));
  if (texel.coverage >= kWholeCoverage || reach * static_cast<float>(weights.extent(0).width) < kLeastMendedReach)
    return texel;
  const std::vector<SeamEdge> edges = seams.near(footprint.uv, chart, reach);
  if (edges.empty()) return texel;
  std::array<Footprint, kSeamPieces * kSeamPieces> pieces;
  for (int i = 0; i < kSeamPieces * kSeamPieces; ++i)
    pieces[i] = piece(footprint, edges, i % kSeamPieces, i / kSeamPieces);
  std::array<FilteredTexel, kSeamPieces * kSeamPieces> looked_up;
  weights.lookup(pieces, LookupFilter::kVarianceMatched, looked_up);
  lookups += pieces.size();
  return mean(looked_up, texel);
}

}  // namespace redmap
