// How well a map stands in for area averages, from footprints of two texels to the whole object.
#pragma once

#include <array>

#include "surface/surface.h"

namespace redmap::bench {

inline constexpr int kLevels = 9;

struct FarError {
  /// RMS of lookup minus area average, over the RMS of the area averages, for footprints 2^level texels wide, levels 1
  /// to 9.
  std::array<double, kLevels> by_level{};
  /// RMS error of footprints centred within two texels of a seam over that of the others, levels 1 to 9 together. Seams
  /// lie where the surface is bent, so that this is above 1 even for lookups that know nothing of charts.
  double seam_over_interior = 0;
  /// The same over the error of the same footprints in a map whose atlas has no seam there; and for levels 1 to 3,
  /// where the atlas serves alone.
  double seam_over_recut = 0, near_seam_over_recut = 0;
};

/// Solid noise on `surface`, a mesh, in a map of `size` texels, looked up as the renderer does it, against brute-force
/// averages over the surface under each footprint: what is over the square on the tangent plane, no farther from the
/// plane than half its width, and faces the same side. `recut`: the same mesh with another atlas.
FarError measure_far_error(const Surface& surface, const Surface& recut, int size);

}  // namespace redmap::bench
