// How far light is followed through surfaces that let it pass, the same on the CPU and on devices.
#pragma once

#include <limits>

namespace redmap {

inline constexpr int kMaxLayers = 16;             ///< surfaces seen through, one behind the other
inline constexpr float kLeastThroughput = 1e-3f;  ///< a quarter of an 8-bit step: nothing behind it can be seen

/// Rays leave a surface this far above it, as a part of half the object's diagonal, and by some roundings of the
/// numbers that led there: well over the error of a float hit, also of objects far away from the camera or the origin.
inline constexpr float kRayOffset = 1e-4f, kRoundings = 4 * std::numeric_limits<float>::epsilon();

}  // namespace redmap
