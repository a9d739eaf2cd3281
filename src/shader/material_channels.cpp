#include "shader/material_channels.h"

#include <algorithm>

namespace redmap {
namespace {

using Channels = ParameterChannels;

/// Keeps the widths defined where nothing is specular, or nothing is in a lobe.
constexpr float kLuminanceFloor = 1e-4f, kWeightFloor = 1e-9f;
/// Largest exponent, for lobes that averaging in floats made narrower than any.
constexpr float kLargestExponent = 1e6f;

}  // namespace

void parameter_channels(const Materials& materials, std::size_t i, float* out) {
  for (int c = 0; c < 3; ++c) {
    out[Channels::kDiffuse + c] = materials.diffuse[c][i];
    out[Channels::kSpecular + c] = materials.specular[c][i];
    out[Channels::kTransmittance + c] = materials.transmittance[c][i];
  }
  const Rgb specular = materials.specular.rgb(i);
  const float luminance = (specular.r + specular.g + specular.b) / 3 + kLuminanceFloor;
  const float ggx = luminance * materials.ggx[0][i];
  out[Channels::kLuminance] = luminance;
  out[Channels::kGgxLuminance] = ggx;
  out[Channels::kPhongVariance] = (luminance - ggx) / (std::max(0.0f, materials.exponent[0][i]) + 2);
  for (int c = 0; c < 3; ++c) out[Channels::kGgxRoughness + c] = ggx * materials.roughness[c][i];
  out[Channels::kGrazing] = materials.grazing[0][i];
}

void set_material(const float* channels, std::size_t i, Materials& materials) {
  for (int c = 0; c < 3; ++c) {
    materials.diffuse[c][i] = channels[Channels::kDiffuse + c];
    materials.specular[c][i] = channels[Channels::kSpecular + c];
    materials.transmittance[c][i] = channels[Channels::kTransmittance + c];
  }
  const float ggx = channels[Channels::kGgxLuminance], phong = channels[Channels::kLuminance] - ggx;
  materials.ggx[0][i] = ggx / std::max(channels[Channels::kLuminance], kWeightFloor);
  const float variance = channels[Channels::kPhongVariance] / std::max(phong, kWeightFloor);
  materials.exponent[0][i] = std::clamp(1 / std::max(variance, kWeightFloor) - 2, 0.0f, kLargestExponent);
  for (int c = 0; c < 3; ++c)
    materials.roughness[c][i] = channels[Channels::kGgxRoughness + c] / std::max(ggx, kWeightFloor);
  materials.grazing[0][i] = channels[Channels::kGrazing];
}

}  // namespace redmap
