// The direction of the grain of an anisotropic reflectance, found by asking for radiance (docs/shading_normals.md).
#pragma once

#include <vector>

#include "shader/shader.h"

namespace redmap {

/// Where the retro-radiance about a normal has the maxima of its second harmonic: the rough direction of a brushed
/// metal.
struct Grain {
  Vec2 turn{1, 0};     ///< cosine and sine of its angle from the x of the frame, modulo half a turn
  bool found = false;  ///< not for isotropic reflectances
};

/// One a pattern, about the z of the frames that `patterns` are asked in, which must be their shading normals. 60 calls
/// each.
std::vector<Grain> estimate_grain(const BoundPatterns& patterns);

}  // namespace redmap
