// How shading frames are turned about their normals, as numbers that can be averaged: second harmonics, since a grain
// has no direction (docs/normals.md).
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "base/vec.h"
#include "map/lookup_limits.h"

namespace redmap {

/// Means of cos and sin of twice the angle, each as (1 + value) / 2, so that they are 0 to 1 like weights.
struct TangentMoments {
  static constexpr int kCount = 2;
};

/// Writes the moments of one turn, given as cosine and sine.
inline void tangent_moments(Vec2 turn, float* out) { out[0] = turn.x * turn.x, out[1] = 0.5f + turn.x * turn.y; }

/// Two turns, of half the weight each, that have the moments `averaged`; one twice where they are close together.
inline std::array<Vec2, 2> turns_of(const float* averaged) {
  const float cosine = 2 * averaged[0] - 1, sine = 2 * averaged[1] - 1;
  const float mean = 0.5f * std::atan2(sine, cosine);
  const float concentration = std::sqrt(cosine * cosine + sine * sine);
  const float apart = concentration > kOneTurn ? 0 : 0.5f * std::acos(concentration);
  return {{{std::cos(mean - apart), std::sin(mean - apart)}, {std::cos(mean + apart), std::sin(mean + apart)}}};
}

}  // namespace redmap
