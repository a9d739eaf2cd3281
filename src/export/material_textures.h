// A reduction map as textures that any renderer takes: masks for k materials, or one material whose every level is
// averaged from the map's own level (compare Olano and Baker 2010).
#pragma once

#include <optional>
#include <vector>

#include "export/material_fit.h"
#include "export/texture.h"
#include "map/reduction_map.h"

namespace redmap {

/// What the texels of a map with normals say of them: "normal" is the mean, RGB, tangent space as in glTF; "spread" the
/// root of the sum of both variances about it, so that GGX's squared roughness grows by the square of it.
struct NormalTextures {
  Texture normal, spread;
};
/// None where the map's normals are the interpolated ones.
std::optional<NormalTextures> normal_textures(const ReductionMap& map);

/// A mask a basis reflectance, "mask00" and so on: how much of it, in parts of `scale`.
struct Masks {
  std::vector<Texture> textures;
  std::vector<float> scales;
};
Masks mask_textures(const ReductionMap& map);

/// glTF's core material: constants, and what varies. Textures replace the constants of the same name.
struct OneMaterial {
  float specular = 1;          ///< reflectance of what is no metal, in parts of glTF's own
  Rgb emission_scale;          ///< of the full byte of `emission`
  Texture base_color;          ///< RGB
  Texture metallic_roughness;  ///< G: roughness, B: metallic, widened by the variance of parts and of normals
  std::optional<Texture> normal, emission, transmission;
};
OneMaterial average_material(const ReductionMap& map, const std::vector<MaterialFit>& fits);

/// A byte of the sRGB transfer function.
std::uint8_t srgb_byte(float linear);

}  // namespace redmap
