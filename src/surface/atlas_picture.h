// An atlas as a picture, as the paper's Fig. 2 shows it: every chart in a colour of its own, with its outline.
#pragma once

#include "base/image.h"
#include "surface/mesh.h"

namespace redmap {

/// `size` x `size` pixels of linear RGB, v upwards, white where there is no chart. The mesh must have uv; those outside
/// [0, 1] are not seen.
Image draw_atlas(const TriangleMesh& mesh, int size);

}  // namespace redmap
