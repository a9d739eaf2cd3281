// The colour spaces of FLIP (Andersson et al. 2020, section 4.1): linear sRGB, CIEXYZ, YCxCz and CIELab, all relative
// to the white of sRGB, D65.
#pragma once

#include <algorithm>
#include <cmath>

#include "base/vec.h"

namespace redmap {

inline Rgb clamped(Rgb c) {
  return {std::clamp(c.r, 0.0f, 1.0f), std::clamp(c.g, 0.0f, 1.0f), std::clamp(c.b, 0.0f, 1.0f)};
}

// The matrix of IEC 61966-2-1 from its primaries and white, and its inverse, in full precision.
inline Vec3 linear_to_xyz(Rgb c) {
  return {0.41238656f * c.r + 0.35759149f * c.g + 0.18045049f * c.b,
          0.21263682f * c.r + 0.71518298f * c.g + 0.07218020f * c.b,
          0.01933062f * c.r + 0.11919716f * c.g + 0.95037259f * c.b};
}
inline Rgb xyz_to_linear(Vec3 c) {
  return {3.24100326f * c.x - 1.53739899f * c.y - 0.49861587f * c.z,
          -0.96922426f * c.x + 1.87592999f * c.y + 0.04155421f * c.z,
          0.05563942f * c.x - 0.20401120f * c.y + 1.05714897f * c.z};
}

/// CIEXYZ with white at (1, 1, 1).
inline Vec3 linear_to_relative_xyz(Rgb c) {
  const Vec3 white = linear_to_xyz({1, 1, 1}), xyz = linear_to_xyz(c);
  return {xyz.x / white.x, xyz.y / white.y, xyz.z / white.z};
}

/// Opponent channels that are linear in light: achromatic, red-green, blue-yellow.
inline Vec3 linear_to_ycxcz(Rgb c) {
  const Vec3 v = linear_to_relative_xyz(c);
  return {116 * v.y - 16, 500 * (v.x - v.y), 200 * (v.y - v.z)};
}
inline Rgb ycxcz_to_linear(Vec3 c) {
  const Vec3 white = linear_to_xyz({1, 1, 1});
  const float y = (c.x + 16) / 116;
  return xyz_to_linear({(y + c.y / 500) * white.x, y * white.y, (y - c.z / 200) * white.z});
}

/// CIELab: lightness 0 to 100, then red-green and blue-yellow.
inline Vec3 linear_to_lab(Rgb c) {
  const auto response = [](float t) {
    constexpr float kKnee = 6.0f / 29;
    return t > kKnee * kKnee * kKnee ? std::cbrt(t) : t / (3 * kKnee * kKnee) + 4.0f / 29;
  };
  const Vec3 v = linear_to_relative_xyz(c);
  return {116 * response(v.y) - 16, 500 * (response(v.x) - response(v.y)), 200 * (response(v.y) - response(v.z))};
}

/// Colours look less colourful in the dark (Hunt 1952): chroma scaled by lightness, section 4.1.2.
inline Vec3 hunt_adjusted(Vec3 lab) { return {lab.x, 0.01f * lab.x * lab.y, 0.01f * lab.x * lab.z}; }

/// Distance for large colour differences (Abasi et al. 2020): city block in lightness, Euclidean in chroma.
inline float hyab_distance(Vec3 a, Vec3 b) { return std::abs(a.x - b.x) + std::hypot(a.y - b.y, a.z - b.z); }

}  // namespace redmap
