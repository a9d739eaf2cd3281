// Pass over the texels for anisotropic shaders whose grain turns: how their shading frames are turned about the shading
// normals (docs/normals.md).
#pragma once

#include "bake/texel_grid.h"

namespace redmap {

/// TangentMoments of every texel, averaged over sub-samples where neighbours differ. Throws BakeInterrupted.
BaseLevel sample_tangents(const TexelGrid& grid, const Shader& shader, const BakeOptions& options,
                          BakeMonitor& monitor);

}  // namespace redmap
