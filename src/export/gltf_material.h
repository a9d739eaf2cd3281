// A material in the terms of glTF 2.0, and its reflectance as a viewer evaluates it: appendix B of the specification
// with the extensions KHR_materials_specular, _clearcoat, _anisotropy, _transmission and _emissive_strength.
#pragma once

#include <array>
#include <cmath>

#include "base/vec.h"
#include "map/slope_moments.h"

namespace redmap {

struct GltfMaterial {
  Rgb base_color{1, 1, 1};  ///< linear, 0 to 1
  float metallic = 0, roughness = 1;
  float specular = 1;           ///< reflectance of what is no metal at grazing angles
  Rgb specular_color{1, 1, 1};  ///< times .04: its reflectance at normal incidence, over `specular`; 0 to 25
  float coat = 0, coat_roughness = 0;
  float anisotropy = 0;           ///< 0 to 1: how far roughness along its direction goes from `roughness` to 1
  float anisotropy_rotation = 0;  ///< of that direction from the tangent, radians, towards the bitangent
  float transmission = 0;         ///< of thin walls, part of the light that is not reflected; tinted by the base colour
  Rgb emission;                   ///< radiance
};

/// What is no metal reflects as much at normal incidence: an index of refraction of 1.5, glTF's default.
inline constexpr float kGltfReflectance = 0.04f;
/// Narrower lobes are not drawn: three.js widens them to this roughness.
inline constexpr float kGltfLeastRoughness = 0.0525f;

/// The reflecting part of a material as numbers that can be fitted: base colour, metallic, roughness, specular,
/// specular colour * .04, coat, coat roughness, anisotropy, its rotation.
inline constexpr int kGltfReflectanceNumbers = 13;
template <typename T>
using GltfNumbers = std::array<T, kGltfReflectanceNumbers>;

GltfNumbers<double> numbers_of(const GltfMaterial& material);

/// Light, viewer and half vector in the shading frame.
struct GltfAngles {
  Vec3 light, viewer, half;
  float difference_cosine;  ///< between half vector and viewer
  GltfAngles(Vec3 to_light, Vec3 to_viewer)
      : light(to_light),
        viewer(to_viewer),
        half(normalized(to_light + to_viewer)),
        difference_cosine(std::max(0.0f, dot(half, to_viewer))) {}
  bool visible() const { return light.z > 0 && viewer.z > 0; }
};

/// The square of GGX's roughness, which is the square of glTF's, as a symmetric matrix over the tangent plane.
template <typename T>
struct SquaredRoughness {
  T xx, xy, yy;
  /// v^T M v of the tangential part of a direction.
  T along(const Vec3& v) const {
    const double x = v.x, y = v.y;
    return xx * (x * x) + xy * (2 * x * y) + yy * (y * y);
  }
};

template <typename T>
SquaredRoughness<T> sum_of(const SquaredRoughness<T>& a, const SquaredRoughness<T>& b) {
  return {a.xx + b.xx, a.xy + b.xy, a.yy + b.yy};
}
/// What the covariance of the normals under a pixel adds: twice their variance, an axis (Olano and Baker 2010;
/// Kaplanyan et al. 2016).
inline SquaredRoughness<double> widening_of(const Covariance2& normals) {
  return {2.0 * static_cast<double>(normals.xx), 2.0 * static_cast<double>(normals.xy),
          2.0 * static_cast<double>(normals.yy)};
}
/// The mean over turns of which the means of cosine and sine of twice the angle are known.
inline SquaredRoughness<double> turned(const SquaredRoughness<double>& squared, double cosine, double sine) {
  const double mean = 0.5 * (squared.xx + squared.yy), half = 0.5 * (squared.xx - squared.yy);
  const double along = half * cosine - squared.xy * sine, across = half * sine + squared.xy * cosine;
  return {mean + along, across, mean - along};
}

/// Of glTF's roughness and anisotropy.
template <typename T>
SquaredRoughness<T> squared_roughness(const T& roughness, const T& anisotropy, const T& rotation) {
  using std::cos, std::sin;
  const T alpha = roughness * roughness, along = alpha + (1.0 - alpha) * anisotropy * anisotropy;
  const T mean = 0.5 * (along * along + alpha * alpha), half = 0.5 * (along * along - alpha * alpha);
  return {mean + half * cos(2.0 * rotation), half * sin(2.0 * rotation), mean - half * cos(2.0 * rotation)};
}
/// How glTF says a squared roughness, the other way round.
struct GltfRoughness {
  float roughness = 0, anisotropy = 0, rotation = 0;
};
GltfRoughness roughness_of(const SquaredRoughness<double>& squared);

/// GGX distribution and height-correlated Smith visibility (Walter et al. 2007, Heitz 2014), anisotropic along any
/// axes.
template <typename T>
T gltf_lobe(const SquaredRoughness<T>& squared, const GltfAngles& at) {
  using std::sqrt;
  const double lz = at.light.z, vz = at.viewer.z, hz = at.half.z;
  const T determinant = squared.xx * squared.yy - squared.xy * squared.xy;
  const SquaredRoughness<T> adjugate{squared.yy, -squared.xy, squared.xx};
  const T d = adjugate.along(at.half) / determinant + hz * hz;
  const T light = sqrt(squared.along(at.light) + lz * lz) * vz, viewer = sqrt(squared.along(at.viewer) + vz * vz) * lz;
  return 0.5 / (static_cast<double>(kPi) * sqrt(determinant) * d * d * (light + viewer));
}

/// Radiance towards the viewer under unit irradiance at normal incidence, the light's cosine included, by lobes of
/// these squared roughnesses.
template <typename T>
std::array<T, 3> gltf_radiance(const GltfNumbers<T>& p, const SquaredRoughness<T>& base_roughness,
                               const SquaredRoughness<T>& coat_roughness, const GltfAngles& at) {
  const auto fifth = [](double c) { return c * c * c * c * c; };
  const T lobe = gltf_lobe<T>(base_roughness, at);
  const double schlick = fifth(1 - static_cast<double>(at.difference_cosine));
  std::array<T, 3> fresnel;
  for (int c = 0; c < 3; ++c) fresnel[c] = p[6 + c] + (1.0 - p[6 + c]) * schlick;
  T strongest = fresnel[0];
  for (int c = 1; c < 3; ++c)
    if (fresnel[c] > strongest) strongest = fresnel[c];
  // A coat of index 1.5 lies over it all.
  const double coat_fresnel = kGltfReflectance + (1 - kGltfReflectance) * fifth(1 - static_cast<double>(at.viewer.z));
  const T coat_part = p[9] * coat_fresnel;
  const T coat_lobe = gltf_lobe<T>(coat_roughness, at);
  std::array<T, 3> out;
  for (int c = 0; c < 3; ++c) {
    const T dielectric = (1.0 - p[5] * strongest) * p[c] * (1 / static_cast<double>(kPi)) + p[5] * fresnel[c] * lobe;
    const T metal = (p[c] + (1.0 - p[c]) * schlick) * lobe;
    const T base = dielectric + p[3] * (metal - dielectric);
    out[c] = (base + coat_part * (coat_lobe - base)) * static_cast<double>(at.light.z);
  }
  return out;
}

/// The same with the material's own roughness.
template <typename T>
std::array<T, 3> gltf_radiance(const GltfNumbers<T>& p, const GltfAngles& at) {
  return gltf_radiance(p, squared_roughness(p[4], p[11], p[12]), squared_roughness(p[10], T(0.0), T(0.0)), at);
}

}  // namespace redmap
