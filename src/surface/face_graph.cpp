// Adjacency by sorting half-edges.
#include "surface/face_graph.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <numeric>
#include <tuple>

namespace redmap {

namespace {

/// The first index of every position's value.
std::vector<std::uint32_t> weld_exactly(const std::vector<Vec3>& positions) {
  std::vector<std::uint32_t> order(positions.size()), representative(positions.size());
  std::iota(order.begin(), order.end(), 0u);
  const auto key = [&](std::uint32_t i) {
    return std::array{positions[i].x, positions[i].y, positions[i].z, float(0)};
  };
  std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    const auto ka = key(a), kb = key(b);
    return ka != kb ? ka < kb : a < b;
  });
  for (std::size_t i = 0; i < order.size(); ++i) {
    const bool same = i > 0 && positions[order[i]] == positions[order[i - 1]];
    representative[order[i]] = same ? representative[order[i - 1]] : order[i];
  }
  return representative;
}

struct HalfEdge {
  std::uint32_t low, high;
  int face, corner;
  bool forward;
};

void connect(const TriangleMesh& mesh, FaceGraph& graph) {
  const std::vector<std::uint32_t> vertex = weld_exactly(mesh.positions);
  std::vector<HalfEdge> edges;
  edges.reserve(3 * mesh.triangles.size());
  for (int f = 0; f < graph.size(); ++f)
    for (int k = 0; k < 3; ++k) {
      const std::uint32_t a = vertex[mesh.triangles[f][k]], b = vertex[mesh.triangles[f][(k + 1) % 3]];
      edges.push_back({std::min(a, b), std::max(a, b), f, k, a < b});
    }
  std::sort(edges.begin(), edges.end(), [](const HalfEdge& a, const HalfEdge& b) {
    return std::tie(a.low, a.high, a.face, a.corner) < std::tie(b.low, b.high, b.face, b.corner);
  });
  for (std::size_t i = 0; i < edges.size();) {
    std::size_t end = i + 1;
    while (end < edges.size() && edges[end].low == edges[i].low && edges[end].high == edges[i].high) ++end;
    const HalfEdge &a = edges[i], &b = edges[end - 1];
    if (end - i == 2 && a.forward != b.forward && a.face != b.face) {
      graph.neighbours[a.face][a.corner] = b.face;
      graph.neighbours[b.face][b.corner] = a.face;
    }
    i = end;
  }
}

}  // namespace

FaceGraph make_face_graph(const TriangleMesh& mesh) {
  FaceGraph graph;
  const auto position = [&](std::uint32_t i) {
    return Eigen::Vector3d(mesh.positions[i].x, mesh.positions[i].y, mesh.positions[i].z);
  };
  for (const auto& [i, j, k] : mesh.triangles) {
    const Eigen::Vector3d a = position(i), b = position(j), c = position(k), n = (b - a).cross(c - a);
    graph.areas.push_back(0.5 * n.norm());
    graph.normals.push_back(n.normalized());
    graph.centroids.push_back((a + b + c) / 3);
  }
  graph.neighbours.assign(mesh.triangles.size(), {-1, -1, -1});
  connect(mesh, graph);
  return graph;
}

FaceGraph subgraph(const FaceGraph& graph, std::span<const int> faces) {
  FaceGraph part;
  if (faces.empty()) return part;
  // The index in the part of every face from the first to the last.
  const auto [first, last] = std::minmax_element(faces.begin(), faces.end());
  std::vector<int> index_of(*last - *first + 1, -1);
  for (int i = 0; i < static_cast<int>(faces.size()); ++i) index_of[faces[i] - *first] = i;
  for (const int f : faces) {
    part.normals.push_back(graph.normals[f]);
    part.centroids.push_back(graph.centroids[f]);
    part.areas.push_back(graph.areas[f]);
    std::array<int, 3> neighbours{-1, -1, -1};
    for (int k = 0; k < 3; ++k) {
      const int next = graph.neighbours[f][k];
      if (next >= *first && next <= *last) neighbours[k] = index_of[next - *first];
    }
    part.neighbours.push_back(neighbours);
  }
  return part;
}

std::vector<std::vector<int>> connected_parts(const FaceGraph& graph, std::span<const int> labels) {
  std::vector<std::vector<int>> parts;
  std::vector<bool> seen(graph.areas.size());
  for (int first = 0; first < graph.size(); ++first) {
    if (seen[first]) continue;
    std::vector<int> part{first};
    seen[first] = true;
    for (std::size_t i = 0; i < part.size(); ++i)
      for (const int next : graph.neighbours[part[i]])
        if (next >= 0 && !seen[next] && labels[next] == labels[first]) {
          seen[next] = true;
          part.push_back(next);
        }
    std::sort(part.begin(), part.end());
    parts.push_back(std::move(part));
  }
  return parts;
}

}  // namespace redmap
