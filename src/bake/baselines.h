// What a reduction map is measured against, built with the same care: averaged material parameters, and mean normals.
#pragma once

#include "map/parameter_channels.h"
#include "map/pyramid.h"
#include "shader/shader.h"
#include "surface/surface.h"

namespace redmap {

/// Writes the channels of material `i`.
void parameter_channels(const Materials& materials, std::size_t i, float* out);
/// The material that averaged channels stand for becomes material `i`.
void set_material(const float* channels, std::size_t i, Materials& materials);

/// Mip-mapped material parameters of `shader` on `surface`, base texels averaged over 4 x 4 points where neighbours
/// differ, as in a reduction map. Throws Error if the shader has no material() to say.
Pyramid<float> build_parameter_pyramid(const Surface& surface, const Shader& shader, int size);

/// Mip-mapped interpolated normals in object space (x, y, z; means, not unit vectors).
Pyramid<float> build_normal_pyramid(const Surface& surface, int size);

}  // namespace redmap
