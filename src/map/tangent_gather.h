// The grains under a footprint: a few turns that stand for all of them.
#pragma once

#include <array>
#include <span>

#include "map/footprint.h"
#include "map/pyramid.h"

namespace redmap {

/// Turns of a grain, as cosine and sine, each of the same weight, ordered by angle.
inline constexpr int kGatheredTurns = 32;
using GatheredTurns = std::array<Vec2, kGatheredTurns>;

/// One entry of `out` a footprint: every texel of `tangents` (TangentMoments) that it overlaps counts by its area and
/// coverage. No turn at all where nothing is covered.
void gather_turns(const WeightPyramid& tangents, std::span<const Footprint> footprints, std::span<GatheredTurns> out);

}  // namespace redmap
