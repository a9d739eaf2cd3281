// Faces of a mesh and who is beside whom, for growing charts.
#pragma once

#include <Eigen/Core>
#include <array>
#include <span>
#include <vector>

#include "surface/mesh.h"

namespace redmap {

struct FaceGraph {
  std::vector<Eigen::Vector3d> normals, centroids;
  std::vector<double> areas;
  /// The face across edge k, from corner k to corner k + 1; -1 where there is none. Only edges with exactly two faces
  /// of opposite direction connect, so that what is not manifold or not oriented comes apart by itself.
  std::vector<std::array<int, 3>> neighbours;

  int size() const { return static_cast<int>(areas.size()); }
};

/// Triangles are neighbours where their positions are equal, whether or not the mesh shares the vertices.
FaceGraph make_face_graph(const TriangleMesh& mesh);

/// The graph of some of the faces alone; face i of the result is `faces[i]`.
FaceGraph subgraph(const FaceGraph& graph, std::span<const int> faces);

/// The faces of each label, further divided where a label is not connected. In order of each part's first face.
std::vector<std::vector<int>> connected_parts(const FaceGraph& graph, std::span<const int> labels);

}  // namespace redmap
