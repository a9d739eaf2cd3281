// A tree of boxes around the triangles of a mesh, for kernels that ask what a ray crosses (kernels/tree.glsl). Not part
// of the public interface.
#pragma once

#include <vector>

#include "gpu/frame_blocks.h"
#include "surface/mesh.h"

namespace redmap {

/// Two vectors a node, each node before its children and its left child right after it (2 triangles - 1 nodes in all):
/// lower corner and, as bits, the number of the node that follows where a ray misses the box; upper corner and, as
/// bits, the triangle, or ~0 where there are children.
std::vector<Vec4> triangle_tree(const TriangleMesh& mesh);

}  // namespace redmap
