#include "bake/baselines.h"

#include <algorithm>
#include <cmath>

#include "bake/texel_grid.h"
#include "base/error.h"
#include "base/parallel.h"

namespace redmap {
namespace {

using Channels = ParameterChannels;

/// Points across a texel, as the default of BakeOptions.
constexpr int kSubSamples = 4;
/// Channels that differ by more are worth sub-samples: two steps of eight bits.
constexpr float kDifference = 2.0f / 255;
/// Keeps the roughness defined where nothing is specular.
constexpr float kLuminanceFloor = 1e-4f;

/// Every texel from its centre, then from sub-samples where neighbours differ.
Pyramid<float> build_averaged(const Surface& surface, int size, int channels, const EvaluatePoints& evaluate,
                              const ValuesDiffer& differ) {
  const TexelGrid grid(surface, size);
  BaseLevel base(grid.extent(), channels, surface.wraps_u());
  BakeMonitor monitor(nullptr);
  average_texels(grid, std::vector<std::uint8_t>(grid.texels(), 1), 1, evaluate, nullptr, monitor, base);
  average_texels(grid, find_differing_texels(base, differ), kSubSamples, evaluate, nullptr, monitor, base);
  return Pyramid<float>(base);
}

}  // namespace

void parameter_channels(const Materials& materials, std::size_t i, float* out) {
  for (int c = 0; c < 3; ++c) {
    out[Channels::kDiffuse + c] = materials.diffuse[c][i];
    out[Channels::kSpecular + c] = materials.specular[c][i];
    out[Channels::kTransmittance + c] = materials.transmittance[c][i];
  }
  const Rgb specular = materials.specular.rgb(i);
  const float luminance = (specular.r + specular.g + specular.b) / 3 + kLuminanceFloor;
  out[Channels::kSpecularLuminance] = luminance;
  out[Channels::kWeightedRoughness] = luminance / (std::max(0.0f, materials.exponent[0][i]) + 2);
}

void set_material(const float* channels, std::size_t i, Materials& materials) {
  for (int c = 0; c < 3; ++c) {
    materials.diffuse[c][i] = channels[Channels::kDiffuse + c];
    materials.specular[c][i] = channels[Channels::kSpecular + c];
    materials.transmittance[c][i] = channels[Channels::kTransmittance + c];
  }
  const float roughness = channels[Channels::kWeightedRoughness];
  materials.exponent[0][i] =
      roughness > 0 ? std::max(0.0f, channels[Channels::kSpecularLuminance] / roughness - 2) : 0.0f;
}

Pyramid<float> build_parameter_pyramid(const Surface& surface, const Shader& shader, int size) {
  if (!shader.info().has_material)
    throw Error("parameters: shader \"{}\" declares no material(): expected one for this baseline", shader.info().name);
  std::vector<Materials> slots(pipeline_slots());
  const auto evaluate = [&](const SurfacePoints& points, std::span<const std::size_t>, std::size_t slot, float* out) {
    shader.bind(points)->materials(slots[slot]);
    for (std::size_t i = 0; i < points.size(); ++i) parameter_channels(slots[slot], i, out + i * Channels::kCount);
  };
  return build_averaged(surface, size, Channels::kCount, evaluate, [](const float* a, const float* b) {
    for (int c = 0; c < Channels::kCount; ++c)
      if (std::abs(a[c] - b[c]) > kDifference * std::max(std::abs(a[c]), std::abs(b[c]))) return true;
    return false;
  });
}

Pyramid<float> build_normal_pyramid(const Surface& surface, int size) {
  const auto evaluate = [](const SurfacePoints& points, std::span<const std::size_t>, std::size_t, float* out) {
    for (std::size_t i = 0; i < points.size(); ++i)
      for (int c = 0; c < 3; ++c) out[3 * i + c] = points.normal[c][i];
  };
  // Normals are smooth within a chart; only its border, where coverage changes, needs sub-samples.
  return build_averaged(surface, size, 3, evaluate, [](const float*, const float*) { return false; });
}

}  // namespace redmap
