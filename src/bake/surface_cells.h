// Cutting a mesh into small cells of equal area for the clusters of a map, whatever its uv are like.
#pragma once

#include "map/surface_clusters.h"
#include "surface/surface.h"

namespace redmap {

/// The clusters of a baked map: about one leaf for every 32 covered texels, each the mean of 16 cells. Empty for
/// surfaces that are not meshes: their map is one chart. The order depends on the mesh alone.
SurfaceClusters build_clusters(const Surface& surface, const WeightPyramid& weights);

}  // namespace redmap
