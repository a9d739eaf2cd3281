// The channels of the pyramid of averaged material parameters, the `parameters` baseline: baked by bake/baselines.h,
// shaded by render.
#pragma once

namespace redmap {

/// Channels of build_parameter_pyramid(). The filtered Phong exponent is luminance / weighted_roughness - 2: the mean
/// of 1 / (exponent + 2), weighted by how much each part reflects, widens the highlight by the variance of the parts.
struct ParameterChannels {
  static constexpr int kDiffuse = 0, kSpecular = 3, kTransmittance = 6;
  static constexpr int kWeightedRoughness = 9;   ///< specular luminance / (exponent + 2)
  static constexpr int kSpecularLuminance = 10;  ///< mean of the specular colour, plus a little
  static constexpr int kCount = 11;
};

}  // namespace redmap
