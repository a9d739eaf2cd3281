// One chart of an atlas in the making: cut out of the mesh, flattened, and checked.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "surface/face_graph.h"

namespace redmap {

struct FlatChart {
  std::vector<int> faces;                     ///< of the whole mesh, ascending
  std::vector<std::array<int, 3>> triangles;  ///< of local vertices, one a face
  std::vector<Eigen::Vector3d> positions;     ///< of local vertices
  std::vector<Eigen::Vector2d> plane;         ///< the same, flattened; lengths as on the surface
  std::vector<std::pair<int, int>> boundary;  ///< edges of one triangle only: from and to local vertices, ordered
  double area = 0;                            ///< on the surface
  double stretch_times_area = 0;              ///< integral of the squared L2 stretch (Sander et al. 2001)
};

/// Cuts `faces` out along every edge whose other face is not among them: vertices are shared across inner edges only.
FlatChart cut_chart(const TriangleMesh& mesh, const FaceGraph& graph, std::vector<int> faces);

/// A triangle in its own plane: corner 0 at the origin, corner 1 on the x axis. All zero if the first two are one.
std::array<Eigen::Vector2d, 3> local_triangle(const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                                              const Eigen::Vector3d& c);

/// Area of a triangle in the plane, negative where it is flipped.
double plane_area(const FlatChart& chart, const std::array<int, 3>& triangle);

/// Whether the chart has the topology of a disk.
bool is_disk(const FlatChart& chart);

/// Fills `plane`: conformal, then as isometric as possible (chart_flattening.h), scaled to the true area and turned to
/// the smallest rectangle, with its corner at the origin. A single triangle keeps its shape. False if there is no sound
/// solution.
bool flatten(FlatChart& chart);

/// Whether every triangle of `plane` keeps its orientation, no two overlap and the L2 stretch stays below the limit.
bool is_sound(FlatChart& chart, double max_l2_stretch);

}  // namespace redmap
