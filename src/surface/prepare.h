// Bringing meshes to a size: weld, subdivide, simplify, normalise. What models fetched for demo and tests go through.
#pragma once

#include <cstddef>

#include "surface/mesh.h"
#include "surface/repair.h"

namespace redmap {

struct PrepareOptions {
  std::size_t triangles = 0;  ///< about as many triangles: subdivided, then simplified; 0 leaves their number alone
  float weld_distance = 0;    ///< vertices up to this far apart become one, as a part of the bounding box's diagonal
  bool largest_part = false;  ///< keep only the connected part with the most triangles
  bool repair = false;        ///< turn, split and fill as repair.h says, after welding
  bool unit_sphere = false;   ///< move and scale so that the bounding sphere is the unit sphere at the origin
};

struct PrepareReport {
  std::size_t welded_vertices = 0;    ///< vertices that became another one
  std::size_t dropped_triangles = 0;  ///< degenerate, doubled, or of a smaller part
  RepairReport repair;
  int subdivisions = 0;                ///< rounds of Loop subdivision
  std::size_t boundary_edges = 0;      ///< of the result: edges of one triangle
  std::size_t non_manifold_edges = 0;  ///< of the result: edges of more than two, or of two that do not agree
  std::size_t vertices = 0, triangles = 0;
};

/// Only positions and triangles go in and come out: normals and uv are dropped. Throws Error if nothing is left.
PrepareReport prepare(TriangleMesh& mesh, const PrepareOptions& options);

/// One round of Loop subdivision (Loop 1987), with boundary rules along edges that do not have exactly two triangles.
TriangleMesh subdivide_loop(const TriangleMesh& mesh);

}  // namespace redmap
