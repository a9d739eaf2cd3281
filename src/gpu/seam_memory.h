// Seams of an atlas as the renderer's shaders read them. Not part of the public interface.
#pragma once

#include <cstdint>
#include <vector>

#include "surface/surface.h"

namespace redmap {

/// The edges of the surface's seams in a grid over uv, and the chart of each triangle, as kernels/seams.glsl lays them
/// out. For meshes.
std::vector<std::uint32_t> seam_data(const Surface& surface);

}  // namespace redmap
