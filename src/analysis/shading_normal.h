// The shading normal of a place whose reflectance is a black box, found by asking for radiance (paper, section 4.5).
//
// Three methods: the paper's great arcs, the reciprocity of Zickler et al. 2002, and a cascade of our own that verifies
// what it finds and says so where it finds nothing (docs/shading_normals.md).
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <string_view>
#include <vector>

#include "shader/shader.h"

namespace redmap {

/// A unit vector, in double precision: what is found is limited by the black box alone.
using Direction = std::array<double, 3>;

struct DirectionPair {
  Direction to_light, to_viewer;
};

/// Radiance of one place under some pairs, all in one space of the caller's choice: the sum over the channels will do.
using AskRadiance = std::function<void(std::span<const DirectionPair> pairs, std::span<double> radiance)>;

enum class NormalMethod {
  kCascade,     ///< verifies itself: gradients, great arcs, circles, search for a lobe, centroid
  kGreatArc,    ///< the paper's, 30 calls: needs black below the horizon and nowhere else. Never notices that it failed
  kReciprocity  ///< Zickler et al., 6 calls: needs a reciprocal reflectance. Fails only where it gets no equation
};
std::string_view label(NormalMethod method);

/// Where radiance is rounded to floats, and so are directions.
inline constexpr double kFloatPrecision = 1.2e-7;
/// Relative rounding of a radiance computed in double precision.
inline constexpr double kDoublePrecision = 1e-15;

/// What decided.
enum class NormalStage { kNone, kGradients, kGreatArcs, kCircles, kLobe, kCentroid, kReciprocity };

struct NormalEstimate {
  Direction normal;  ///< the geometric normal if none was found
  bool found = false;
  NormalStage stage = NormalStage::kNone;
  int calls = 0;  ///< radiances asked for
};

/// Estimates the shading normal, on the side of `geometric_normal`, in the space of the directions. `precision` is the
/// relative rounding of the radiance. What the cascade says it found is right to .01 rad for reflectances that are
/// isotropic, or black below the horizon, about one normal.
NormalEstimate estimate_shading_normal(const AskRadiance& ask, const Direction& geometric_normal,
                                       NormalMethod method = NormalMethod::kCascade,
                                       double precision = kDoublePrecision);

/// Shading normals of bound patterns, in the frames that their directions are in.
struct ShadingNormals {
  Planes<3> normal;                 ///< (0, 0, 1) where none was found
  std::vector<std::uint8_t> found;  ///< one a pattern
  std::uint64_t calls = 0;
};
ShadingNormals estimate_shading_normals(const BoundPatterns& patterns, NormalMethod method = NormalMethod::kCascade);

}  // namespace redmap
