// Repairing a mesh's topology: what scans with holes and models of pieces need before anything can be grown on them.
#pragma once

#include <cstddef>

#include "surface/mesh.h"

namespace redmap {

struct RepairReport {
  std::size_t turned_triangles = 0;  ///< whose winding did not agree with their neighbours', or that faced inwards
  std::size_t split_vertices = 0;    ///< copies made where sheets met in an edge or a point only
  std::size_t filled_holes = 0, filling_triangles = 0;
};

/// Holes of up to so many edges are filled, as long as they are small against their part; larger ones are taken for
/// openings that are meant.
inline constexpr std::size_t kLargestHole = 64;

/// In this order: turns triangles so that neighbours agree and closed parts face outwards; gives each sheet its own
/// vertices where more than two triangles meet in an edge, or where parts touch in a point; fills holes of up to
/// `largest_hole` edges. Vertices are expected to be welded. Only positions and triangles go in and come out.
RepairReport repair(TriangleMesh& mesh, std::size_t largest_hole = kLargestHole);

}  // namespace redmap
