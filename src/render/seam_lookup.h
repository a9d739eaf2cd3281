// Lookups whose footprint reaches over a seam of the atlas: each side is looked up in its own chart.
#pragma once

#include "map/pyramid.h"
#include "surface/seams.h"

namespace redmap {

/// `texel`, what `footprint` gave in `weights`, made whole: where it was not fully covered and a seam of `chart`, that
/// of the footprint's centre, is under it, the footprint is cut into pieces, each is looked up on its side of the seam,
/// and they are averaged by their coverage. Adds the lookups this took to `lookups`.
FilteredTexel mend_at_seams(const WeightPyramid& weights, const Seams& seams, std::uint32_t chart,
                            const Footprint& footprint, const FilteredTexel& texel, std::uint64_t& lookups);

}  // namespace redmap
