// Exported textures rendered as an engine would: bytes, lookups, glTF's reflectance, nothing of the shader left.
#pragma once

#include <memory>
#include <vector>

#include "export/material_textures.h"
#include "render/shading.h"

namespace redmap::bench {

/// k materials mixed by k masks; their lobes are widened by the covariance of the normals under a pixel and turned with
/// the grain.
std::unique_ptr<ObjectShading> make_masked_shading(std::shared_ptr<const Shader> shader, const Masks& masks,
                                                   const std::vector<MaterialFit>& fits,
                                                   const std::optional<NormalTextures>& normals,
                                                   const std::optional<Texture>& grain);

/// One material, whose textures say it all.
std::unique_ptr<ObjectShading> make_one_material_shading(std::shared_ptr<const Shader> shader, const OneMaterial& one);

}  // namespace redmap::bench
