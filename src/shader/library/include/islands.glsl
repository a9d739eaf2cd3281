// Irregular islands that cover about half of space: the sign of two octaves of noise.
#ifndef REDMAP_ISLANDS_GLSL
#define REDMAP_ISLANDS_GLSL
#include "include/noise.glsl"

float island_height(vec3 position, float scale) {
  // The second octave is not a multiple of the first, and shifted, so that their lattices do not line up.
  return gradient_noise(position * scale) + 0.5 * gradient_noise(position * (scale * 2.0714) + vec3(5.3));
}

#endif
