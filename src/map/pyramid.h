// Pyramids of interleaved texels and the anisotropic, variance-matched lookup (paper, sections 4.4 and 5.3; departures
// in docs/lookup.md).
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "base/extent.h"
#include "base/surface_points.h"
#include "map/footprint.h"

namespace redmap {

/// Most channels a pyramid can have, coverage not counted.
inline constexpr int kMaxChannels = 16;

/// Result of a lookup: filtered channels, already divided by the filtered coverage.
struct FilteredTexel {
  float coverage = 0;
  alignas(32) std::array<float, kMaxChannels> channel{};
};

/// How a footprint is filtered.
enum class LookupFilter {
  kVarianceMatched,  ///< anisotropic: bilinear taps along the major axis, levels mixed by variance
  kEnclosingSquare,  ///< the paper's: trilinear at the size of the enclosing square
};

/// Axes of a footprint in texels of `extent`: the singular values of its Jacobian.
struct FootprintAxes {
  float major = 0, minor = 0;
  Vec2 major_direction_uv;  ///< of the major axis, scaled so that it spans the footprint once in uv
};
FootprintAxes footprint_axes(const Footprint& footprint, Extent extent);

/// Levels of texels, each a coverage and `channels()` values. Component is std::uint8_t (value = byte / 255 * scale of
/// the channel) or float.
template <typename Component>
class Pyramid;

using WeightPyramid = Pyramid<std::uint8_t>;

}  // namespace redmap
