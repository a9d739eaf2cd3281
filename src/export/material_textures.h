// A reduction map as textures that any renderer takes: masks for k materials, or one material whose every level is
// averaged from the map's own level (compare Olano and Baker 2010).
#pragma once

#include <optional>
#include <vector>

#include "export/material_fit.h"
#include "export/texture.h"
#include "map/reduction_map.h"

namespace redmap {

/// What the texels of a map with normals say of them, in tangent space: "normal" is the mean, RGB, as in glTF;
/// "moments" are the means of x^2, y^2 and (x y + 1) / 2 in parts of `scale`, to be filtered like any colour (Olano and
/// Baker 2010). The covariance under a footprint, which widens a lobe, is the filtered moments less the products of the
/// filtered mean. "fine" holds the second byte of both, signed: value = texel + fine / 256 - 1 / 510. Without it fine
/// grooves beside deep ones are lost, and narrow highlights are shifted.
struct NormalTextures {
  Texture normal, normal_fine, moments, moments_fine;
  float scale = 1;
};
/// None where the map's normals are the interpolated ones.
std::optional<NormalTextures> normal_textures(const ReductionMap& map);

/// How frames of the materials are turned about the normal: "grain" has the means of cos^2 of the angle, and of (1 +
/// sin of twice the angle) / 2, to be filtered like any colour. None where they are along the tangents.
std::optional<Texture> grain_texture(const ReductionMap& map);

/// A mask a basis reflectance, "mask00" and so on: how much of it, in parts of `scale`.
struct Masks {
  std::vector<Texture> textures;
  std::vector<float> scales;
};
Masks mask_textures(const ReductionMap& map);

/// glTF's core material: constants, and what varies. Textures replace the constants of the same name.
struct OneMaterial {
  float specular = 1;                 ///< reflectance of what is no metal, in parts of glTF's own
  Rgb emission_scale;                 ///< of the full byte of `emission`
  Texture base_color;                 ///< RGB
  Texture metallic_roughness;         ///< G: roughness, B: metallic, widened by the variance of parts and of normals
  std::optional<Texture> anisotropy;  ///< RG: direction, (x + 1) / 2; B: strength
  std::optional<Texture> normal, emission, transmission;
};
OneMaterial average_material(const ReductionMap& map, const std::vector<MaterialFit>& fits);

/// A byte of the sRGB transfer function.
std::uint8_t srgb_byte(float linear);

}  // namespace redmap
