// The directions a reflectance is sampled in (paper, section 4.2.1, Fig. 3).
#pragma once

#include "shader/shader.h"

namespace redmap {

/// Samples in the paper's table, the last of which is light that passes straight through.
inline constexpr int kDirectionSamples = 35;
/// Samples that are reflections: all but the last.
inline constexpr int kReflectionSamples = kDirectionSamples - 1;

/// The kReflectionSamples direction pairs of Fig. 3 in the shading frame, in the table's order. Pairs of (85, 95)
/// degrees look from below the surface: a shader answers black, and the rows stay zero.
DirectionPairs reflection_samples();

}  // namespace redmap
