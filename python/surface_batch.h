// Arrays of places and directions as the renderer's batch of hits, so that Python shades as frames do.
#pragma once

#include <memory>

#include "arrays.h"
#include "render/shading.h"

namespace redmap::python {

/// One light of unit irradiance. Throws Error unless there is one direction a hit.
ShadingBatch batch_of(std::vector<SurfaceHit> hits, const RowsIn<3>& to_light, const RowsIn<3>& to_viewer);

/// The radiance of every hit.
RowsOut<3> shade_batch(const ObjectShading& shading, const ShadingBatch& batch);

}  // namespace redmap::python
