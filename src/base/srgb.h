// The transfer function of sRGB (IEC 61966-2-1), between stored values and linear light, both in [0, 1].
#pragma once

#include <cmath>

namespace redmap {

inline float srgb_to_linear(float stored) {
  return stored <= 0.04045f ? stored / 12.92f : std::pow((stored + 0.055f) / 1.055f, 2.4f);
}

inline float linear_to_srgb(float linear) {
  return linear <= 0.0031308f ? linear * 12.92f : 1.055f * std::pow(linear, 1 / 2.4f) - 0.055f;
}

}  // namespace redmap
