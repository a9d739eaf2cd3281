// Materials as numbers that can be averaged, for the `parameters` baseline: baked by bake/baselines.h, shaded by
// render.
#pragma once

#include "shader/shader.h"

namespace redmap {

/// One list of channels for those who bake them and those who render them. Widths of lobes are weighted by how much
/// each part reflects in that lobe, so that their mean widens the highlight by the variance of the parts.
struct ParameterChannels {
  static constexpr int kDiffuse = 0, kSpecular = 3, kTransmittance = 6;
  static constexpr int kLuminance = 9;       ///< mean of the specular colour, plus a little
  static constexpr int kGgxLuminance = 10;   ///< the part of it in the GGX lobe
  static constexpr int kPhongVariance = 11;  ///< luminance of the Phong lobe / (exponent + 2)
  static constexpr int kGgxRoughness = 12;   ///< luminance of the GGX lobe * squared roughness: xx, xy, yy
  static constexpr int kGrazing = 15;
  static constexpr int kCount = 16;
};

/// Writes the channels of material `i`.
void parameter_channels(const Materials& materials, std::size_t i, float* out);
/// The material that averaged channels stand for becomes material `i`; the covariance of its normals stays as it is.
void set_material(const float* channels, std::size_t i, Materials& materials);

}  // namespace redmap
