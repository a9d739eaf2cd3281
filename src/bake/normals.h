// Third pass over the texels, for shaders that perturb normals: how their shading normals are distributed (paper,
// section 4.5).
#pragma once

#include "bake/bake.h"
#include "bake/texel_grid.h"

namespace redmap {

/// Means of x, y, x^2, x y and y^2 of the shading normals of every texel, in the interpolated frame: what
/// NormalPyramid is built from. Taken over `sub_samples`^2 points, but where two kinds of normals meet in a texel it
/// has one of them: their average would blur a highlight. Throws BakeInterrupted.
BaseLevel sample_normals(const TexelGrid& grid, const Shader& shader, int sub_samples, BakeMonitor& monitor);

}  // namespace redmap
