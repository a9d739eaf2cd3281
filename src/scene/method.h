// The ways to render a scene, whoever renders it.
#pragma once

#include <string_view>

namespace redmap {

enum class Method {
  kOriginal,     ///< the shader itself, at the same rays as the map
  kSupersample,  ///< the shader itself, `spp` stratified and jittered samples a pixel
  kParameters,   ///< mip-mapped averaged material parameters: what production does today
  kPaper,        ///< the paper's section 5 to the letter
  kMap,          ///< the reduction map
};
inline constexpr std::string_view kMethodNames[] = {"original", "supersample", "parameters", "paper", "map"};

/// Rays a pixel for original, parameters and map.
enum class Quality {
  kFast,     ///< one, and more at silhouettes, chart seams and occlusions
  kDefault,  ///< 2 x 2, and more there
};

}  // namespace redmap
