// Directions that the paper's table leaves out: whether a basis chosen by the table holds there too, and which of them
// to add to it where it does not (docs/bake.md).
#pragma once

#include <cstdint>
#include <vector>

#include "analysis/directions.h"

namespace redmap {

/// Pairs from all around, light and viewer at any azimuth: half of them near the mirror direction, half anywhere.
/// Different ones for each seed.
DirectionPairs held_out_samples(std::uint64_t seed);

/// The paper's table, and what it had to be extended by.
struct DirectionChoice {
  DirectionPairs directions;
  int added = 0;  ///< at the end of `directions`
  /// Residuals in directions that were held out, of the worst place: RMS over them, each scaled by its own RMS over the
  /// places. By the table alone, and by all of `directions`.
  float disagreement_of_table = 0, disagreement = 0;
};

/// `patterns`: some hundred places all over a surface. Adds held-out directions while a basis of up to `max_basis` of
/// these places that is within `tolerance` on the directions is not so, by far, elsewhere.
DirectionChoice choose_directions(const BoundPatterns& patterns, float tolerance, int max_basis);

}  // namespace redmap
