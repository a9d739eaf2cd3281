// Pyramids of interleaved texels and the anisotropic, variance-matched lookup (paper, sections 4.4 and 5.3; departures
// in docs/lookup.md).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "base/surface_points.h"
#include "map/footprint.h"

namespace redmap {

/// Most channels a pyramid can have, coverage included.
inline constexpr int kMaxChannels = 20;

/// Result of a lookup: filtered channels, already divided by the filtered coverage.
struct FilteredTexel {
  float coverage = 0;
  std::array<float, kMaxChannels> channel{};
};

/// How a footprint is filtered.
enum class LookupFilter {
  kVarianceMatched,  ///< anisotropic: bilinear taps along the major axis, levels mixed by variance
  kEnclosingSquare,  ///< the paper's: trilinear at the size of the enclosing square
};

}  // namespace redmap
