// Which triangles of an atlas hang together.
#pragma once

#include <cstdint>
#include <vector>

#include "surface/mesh.h"

namespace redmap {

/// The chart of each triangle, numbered by first appearance: triangles that share a corner both on the surface and in
/// uv, whether or not they share its indices.
std::vector<std::uint32_t> find_charts(const TriangleMesh& mesh);

}  // namespace redmap
