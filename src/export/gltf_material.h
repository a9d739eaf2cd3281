// A material in the terms of glTF 2.0, and its reflectance as a viewer evaluates it: appendix B of the specification
// with the extensions KHR_materials_specular, _clearcoat, _transmission and _emissive_strength.
#pragma once

#include <array>
#include <cmath>

#include "base/vec.h"

namespace redmap {

struct GltfMaterial {
  Rgb base_color{1, 1, 1};  ///< linear, 0 to 1
  float metallic = 0, roughness = 1;
  float specular = 1;           ///< reflectance of what is no metal at grazing angles
  Rgb specular_color{1, 1, 1};  ///< times .04: its reflectance at normal incidence, over `specular`; 0 to 25
  float coat = 0, coat_roughness = 0;
  float transmission = 0;  ///< of thin walls, part of the light that is not reflected; tinted by the base colour
  Rgb emission;            ///< radiance
};

/// What is no metal reflects as much at normal incidence: an index of refraction of 1.5, glTF's default.
inline constexpr float kGltfReflectance = 0.04f;

/// The reflecting part of a material as numbers that can be fitted: base colour, metallic, roughness, specular,
/// specular colour * .04, coat, coat roughness.
inline constexpr int kGltfReflectanceNumbers = 11;
template <typename T>
using GltfNumbers = std::array<T, kGltfReflectanceNumbers>;

GltfNumbers<double> numbers_of(const GltfMaterial& material);

/// Light and viewer over the shading normal, as far as isotropic reflectances need them.
struct GltfAngles {
  double light_cosine, viewer_cosine, half_cosine, difference_cosine;
  GltfAngles(Vec3 to_light, Vec3 to_viewer) : light_cosine(to_light.z), viewer_cosine(to_viewer.z) {
    const Vec3 half = normalized(to_light + to_viewer);
    half_cosine = half.z, difference_cosine = std::max(0.0f, dot(half, to_viewer));
  }
  bool visible() const { return light_cosine > 0 && viewer_cosine > 0; }
};

/// GGX distribution and height-correlated Smith visibility (Walter et al. 2007, Heitz 2014); `alpha2`: the square of
/// GGX's roughness, which is the square of glTF's.
template <typename T>
T gltf_lobe(const T& alpha2, const GltfAngles& at) {
  using std::sqrt;
  const T d = (alpha2 - 1.0) * (at.half_cosine * at.half_cosine) + 1.0;
  const T light = sqrt(alpha2 + (1.0 - alpha2) * (at.light_cosine * at.light_cosine)) * at.viewer_cosine;
  const T viewer = sqrt(alpha2 + (1.0 - alpha2) * (at.viewer_cosine * at.viewer_cosine)) * at.light_cosine;
  return alpha2 / (static_cast<double>(kPi) * d * d) * 0.5 / (light + viewer);
}

/// Radiance towards the viewer under unit irradiance at normal incidence, the light's cosine included. `widening` is
/// added to the square of GGX's roughness: twice the variance of the normals under a pixel, an axis (Olano and Baker
/// 2010; Kaplanyan et al. 2016).
template <typename T>
std::array<T, 3> gltf_radiance(const GltfNumbers<T>& p, const GltfAngles& at, double widening = 0) {
  const auto fifth = [](double c) { return c * c * c * c * c; };
  const T roughness2 = p[4] * p[4], coat_roughness2 = p[10] * p[10];
  const auto widened = [&](const T& alpha2) { return alpha2 + widening < 1.0 ? alpha2 + widening : T(1.0); };
  const T lobe = gltf_lobe<T>(widened(roughness2 * roughness2), at);
  const double schlick = fifth(1 - at.difference_cosine);
  std::array<T, 3> fresnel;
  for (int c = 0; c < 3; ++c) fresnel[c] = p[6 + c] + (1.0 - p[6 + c]) * schlick;
  T strongest = fresnel[0];
  for (int c = 1; c < 3; ++c)
    if (fresnel[c] > strongest) strongest = fresnel[c];
  // A coat of index 1.5 lies over it all.
  const double coat_fresnel = kGltfReflectance + (1 - kGltfReflectance) * fifth(1 - at.viewer_cosine);
  const T coat_part = p[9] * coat_fresnel;
  const T coat_lobe = gltf_lobe<T>(widened(coat_roughness2 * coat_roughness2), at);
  std::array<T, 3> out;
  for (int c = 0; c < 3; ++c) {
    const T dielectric = (1.0 - p[5] * strongest) * p[c] * (1 / static_cast<double>(kPi)) + p[5] * fresnel[c] * lobe;
    const T metal = (p[c] + (1.0 - p[c]) * schlick) * lobe;
    const T base = dielectric + p[3] * (metal - dielectric);
    out[c] = (base + coat_part * (coat_lobe - base)) * at.light_cosine;
  }
  return out;
}

}  // namespace redmap
