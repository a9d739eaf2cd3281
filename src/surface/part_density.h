// Texel density by part of a mesh. Internal to the surface module.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "surface/face_graph.h"

namespace redmap {

/// The density of each triangle: that of its group, else of its material, else 1. Throws Error on a name that is no
/// part of `mesh`, and on a density that is not above 0.
std::vector<float> triangle_densities(const TriangleMesh& mesh, const std::map<std::string, float>& part_density);

/// Takes faces of different density apart, so that charts end between them.
void cut_between_densities(const std::vector<float>& densities, FaceGraph& graph);

}  // namespace redmap
