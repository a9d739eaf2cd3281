// What a reduction map is measured against, built with the same care: averaged material parameters, and mean normals.
#pragma once

#include "map/pyramid.h"
#include "shader/material_channels.h"
#include "surface/surface.h"

namespace redmap {

/// Mip-mapped material parameters of `shader` on `surface`, base texels averaged over 4 x 4 points where neighbours
/// differ, as in a reduction map. Throws Error if the shader has no material() to say.
Pyramid<float> build_parameter_pyramid(const Surface& surface, const Shader& shader, int size);

/// Mip-mapped slopes of the shading normals of `shader` against the interpolated ones (map/slope_moments.h),
/// sub-samples likewise. Throws Error if the shader does not perturb normals.
Pyramid<float> build_slope_pyramid(const Surface& surface, const Shader& shader, int size);

/// The paper's mip-mapped normals in object space: means (x, y, z; not unit vectors) of the interpolated ones, or of
/// the shading normals together with their second moments (map/normal_moments.h) where the shader perturbs them.
Pyramid<float> build_normal_pyramid(const Surface& surface, const Shader& shader, int size);

}  // namespace redmap
