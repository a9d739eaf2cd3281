#include "surface/part_density.h"

#include <cmath>

#include "base/error.h"

namespace redmap {

std::vector<float> triangle_densities(const TriangleMesh& mesh, const std::map<std::string, float>& part_density) {
  for (const auto& [name, density] : part_density) {
    if (!(density > 0) || !std::isfinite(density))
      throw Error("atlas: density of part \"{}\": expected a number above 0, found {}", name, density);
    select_part(mesh, name);
  }
  std::vector<float> of_part;
  for (const MeshPart& part : mesh.parts) {
    auto found = part_density.find(part.group);
    if (found == part_density.end()) found = part_density.find(part.material);
    of_part.push_back(found == part_density.end() ? 1 : found->second);
  }
  std::vector<float> densities(mesh.triangles.size(), 1);
  for (std::size_t t = 0; t < mesh.triangle_parts.size(); ++t) densities[t] = of_part[mesh.triangle_parts[t]];
  return densities;
}

void cut_between_densities(const std::vector<float>& densities, FaceGraph& graph) {
  for (std::size_t f = 0; f < densities.size(); ++f)
    for (int& neighbour : graph.neighbours[f])
      if (neighbour >= 0 && densities[neighbour] != densities[f]) neighbour = -1;
}

}  // namespace redmap
