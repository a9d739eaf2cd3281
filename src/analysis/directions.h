// The directions a reflectance is sampled in (paper, section 4.2.1, Fig. 3).
#pragma once

#include "shader/shader.h"

namespace redmap {

/// The 34 direction pairs of Fig. 3 that are reflections, in the shading frame and in the table's order; the last of
/// its 35 samples is light that passes straight through. Pairs of (85, 95) degrees look from below the surface: a
/// shader answers black, and the rows stay zero.
DirectionPairs reflection_samples();

}  // namespace redmap
