// Exports of a reduction map for renderers that are not ours: what all of them are made from, and one function a kind.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "export/export_folder.h"
#include "export/material_fit.h"
#include "map/reduction_map.h"
#include "scene/scene.h"

namespace redmap {

struct ExportInput {
  std::string name;  ///< of files and materials
  std::shared_ptr<const ReductionMap> map;
  std::shared_ptr<const Shader> shader;
  std::shared_ptr<const Surface> surface;  ///< that the map was baked on; null where no scene was named
  std::vector<MaterialFit> fits;           ///< of the basis; empty for GLSL, which asks the shader itself
};

enum class MaterialCount {
  kOne,       ///< one averaged material
  kOneABasis  ///< as many as basis reflectances, and masks
};

/// NAME.gltf with its buffer and PNG textures, and the same textures as KTX2 with all levels. With kOneABasis masks and
/// fitted materials stand beside the averaged one. Throws Error without a surface.
void export_gltf(const ExportInput& input, MaterialCount count, ExportFolder& folder);
/// The textures of both, every level our own, as KTX 2.0; masks are an array texture.
void export_ktx2(const ExportInput& input, ExportFolder& folder);
/// The same as tiled, mip-mapped TIFF for texture systems, with what `maketx` writes of them.
void export_tx(const ExportInput& input, ExportFolder& folder);
/// NAME.mtlx: a MaterialX document that mixes the fitted surfaces by masks. File names keep the UDIM number of `name`
/// ("body.1001" gives "body.<UDIM>.mask00.png").
void export_mtlx(const ExportInput& input, ExportFolder& folder);
enum class Compression {
  kNone,
  kGzip  ///< beside each file of numbers the same as .gz, for pages to load
};

/// redmap.glsl, with a function redmap_shade() that is the whole map for OpenGL 3.3, Vulkan and WebGL2, weights.bin and
/// words.bin, which it reads, and mesh.bin. The manifest says which parameters may still be changed. Throws Error
/// without a surface, and for shaders that transmit, have images or are plug-ins.
void export_glsl(const ExportInput& input, Compression compression, ExportFolder& folder);

}  // namespace redmap
