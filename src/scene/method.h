// The ways to render a scene, whoever renders it.
#pragma once

#include <algorithm>
#include <iterator>
#include <string_view>

#include "base/error.h"

namespace redmap {

enum class Method {
  kOriginal,     ///< the shader itself, at the same rays as the map
  kSupersample,  ///< the shader itself, `spp` stratified and jittered samples a pixel
  kParameters,   ///< mip-mapped averaged material parameters: what production does today
  kPaper,        ///< the paper's section 5 to the letter
  kMap,          ///< the reduction map
};
inline constexpr std::string_view kMethodNames[] = {"original", "supersample", "parameters", "paper", "map"};

/// Rays a pixel for original, parameters and map, and how many of their hits are looked up and shaded.
enum class Quality {
  kFast,      ///< one, and more at silhouettes, chart seams and occlusions
  kBalanced,  ///< one, looked up in quarters, and more there, where the surface bends, and around highlights
  kDefault,   ///< 2 x 2, and more there
};
inline constexpr std::string_view kQualityNames[] = {"fast", "balanced", "default"};
inline std::string_view name_of(Quality quality) { return kQualityNames[static_cast<std::size_t>(quality)]; }
/// Throws Error if there is none of that name.
inline Quality quality_of(std::string_view name) {
  const auto found = std::find(std::begin(kQualityNames), std::end(kQualityNames), name);
  if (found == std::end(kQualityNames))
    throw Error("quality: expected \"fast\", \"balanced\" or \"default\", found \"{}\"", name);
  return static_cast<Quality>(found - std::begin(kQualityNames));
}

}  // namespace redmap
