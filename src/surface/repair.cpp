// Orientation spreads over manifold edges (breadth first); sheets come apart by union-find over the corners of
// triangles; holes are loops of boundary edges, closed by the triangulation that triangulate.h gives their polygon.
#include "surface/repair.h"

#include <algorithm>
#include <map>

#include "surface/triangulate.h"

namespace redmap {

namespace {

/// One side of a triangle: corners k and k + 1.
struct Side {
  std::uint32_t triangle;
  int corner;
};

using EdgeKey = std::pair<std::uint32_t, std::uint32_t>;

std::map<EdgeKey, std::vector<Side>> sides_of(const TriangleMesh& mesh) {
  std::map<EdgeKey, std::vector<Side>> edges;
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t)
    for (int k = 0; k < 3; ++k)
      edges[std::minmax(mesh.triangles[t][k], mesh.triangles[t][(k + 1) % 3])].push_back({t, k});
  return edges;
}

/// Whether a triangle runs along the edge upwards.
bool runs_upwards(const Triangle& t, const EdgeKey& edge) {
  for (int k = 0; k < 3; ++k)
    if (t[k] == edge.first && t[(k + 1) % 3] == edge.second) return true;
  return false;
}

/// Six times the volume that the triangles enclose, seen from `origin`.
double volume(const TriangleMesh& mesh, const std::vector<std::uint32_t>& triangles, Vec3 origin) {
  double sum = 0;
  for (const std::uint32_t i : triangles) {
    const auto& [a, b, c] = mesh.triangles[i];
    const Vec3 p = mesh.positions[a] - origin, q = mesh.positions[b] - origin, r = mesh.positions[c] - origin;
    sum += double(dot(p, cross(q, r)));
  }
  return sum;
}

/// Walks over manifold edges from triangle to triangle, turning those that do not agree with where the walk came from.
class Orienter {
 public:
  explicit Orienter(TriangleMesh& mesh)
      : mesh_(mesh), before_(mesh.triangles), neighbours_(mesh.triangles.size()), is_open_(mesh.triangles.size()) {
    for (const auto& [edge, sides] : sides_of(mesh)) {
      if (sides.size() == 2) {
        neighbours_[sides[0].triangle].push_back({sides[1].triangle, edge});
        neighbours_[sides[1].triangle].push_back({sides[0].triangle, edge});
      } else {
        for (const Side& side : sides) is_open_[side.triangle] = 1;
      }
    }
  }

  std::size_t run() {
    std::vector<std::uint8_t> visited(mesh_.triangles.size());
    for (std::uint32_t start = 0; start < visited.size(); ++start)
      if (!visited[start]) orient_part(start, visited);
    std::size_t turned = 0;
    for (std::size_t t = 0; t < before_.size(); ++t) turned += before_[t] != mesh_.triangles[t];
    return turned;
  }

 private:
  struct Neighbour {
    std::uint32_t triangle;
    EdgeKey edge;
  };

  void turn(std::uint32_t t) { std::swap(mesh_.triangles[t][1], mesh_.triangles[t][2]); }

  void orient_part(std::uint32_t start, std::vector<std::uint8_t>& visited) {
    std::vector<std::uint32_t> part{start};
    visited[start] = 1;
    bool closed = true;
    for (std::size_t i = 0; i < part.size(); ++i) {
      closed &= !is_open_[part[i]];
      for (const Neighbour& next : neighbours_[part[i]]) {
        if (visited[next.triangle]) continue;
        visited[next.triangle] = 1;
        if (runs_upwards(mesh_.triangles[part[i]], next.edge) ==
            runs_upwards(mesh_.triangles[next.triangle], next.edge))
          turn(next.triangle);
        part.push_back(next.triangle);
      }
    }
    settle_side(part, closed);
  }

  /// Closed parts face outwards; open ones as most of their triangles did.
  void settle_side(const std::vector<std::uint32_t>& part, bool closed) {
    std::size_t turned = 0;
    for (const std::uint32_t t : part) turned += before_[t] != mesh_.triangles[t];
    const bool inside_out =
        closed ? volume(mesh_, part, mesh_.positions[mesh_.triangles[part[0]][0]]) < 0 : 2 * turned > part.size();
    if (inside_out)
      for (const std::uint32_t t : part) turn(t);
  }

  TriangleMesh& mesh_;
  const std::vector<Triangle> before_;
  std::vector<std::vector<Neighbour>> neighbours_;
  std::vector<std::uint8_t> is_open_;  // triangles with an edge that is not between exactly two
};

/// Union-find; a set goes by its smallest member.
class DisjointSets {
 public:
  explicit DisjointSets(std::size_t size) {
    parent_.reserve(size);
    for (std::uint32_t member = 0; member < size; ++member) parent_.push_back(member);
  }
  std::uint32_t find(std::uint32_t member) {
    while (parent_[member] != member) member = parent_[member] = parent_[parent_[member]];
    return member;
  }
  void join(std::uint32_t a, std::uint32_t b) {
    a = find(a), b = find(b);
    parent_[std::max(a, b)] = std::min(a, b);
  }

 private:
  std::vector<std::uint32_t> parent_;
};

/// Corners stay one vertex where they meet across edges of exactly two triangles that agree.
std::size_t split_sheets(TriangleMesh& mesh) {
  DisjointSets sets(3 * mesh.triangles.size());
  for (const auto& [edge, sides] : sides_of(mesh)) {
    if (sides.size() != 2) continue;
    const auto [a, i] = sides[0];
    const auto [b, j] = sides[1];
    const bool agree = mesh.triangles[a][i] == mesh.triangles[b][(j + 1) % 3];
    if (!agree) continue;
    sets.join(3 * a + i, 3 * b + (j + 1) % 3);
    sets.join(3 * a + (i + 1) % 3, 3 * b + j);
  }
  // The first set of a vertex keeps it, every further one gets a copy.
  std::vector<std::uint32_t> owner(mesh.positions.size(), ~0u);
  std::map<std::uint32_t, std::uint32_t> copies;
  const std::size_t before = mesh.positions.size();
  for (std::uint32_t corner = 0; corner < 3 * mesh.triangles.size(); ++corner) {
    std::uint32_t& vertex = mesh.triangles[corner / 3][corner % 3];
    const std::uint32_t set = sets.find(corner);
    if (owner[vertex] == ~0u) owner[vertex] = set;
    if (owner[vertex] == set) continue;
    const auto [copy, is_new] = copies.try_emplace(set, static_cast<std::uint32_t>(mesh.positions.size()));
    if (is_new) mesh.positions.push_back(mesh.positions[vertex]);
    vertex = copy->second;
  }
  return mesh.positions.size() - before;
}

/// The boundary's loops, each in the winding of triangles that would close it. After split_sheets() a vertex has at
/// most one boundary edge that starts there.
std::vector<std::vector<std::uint32_t>> boundary_loops(const TriangleMesh& mesh) {
  std::map<std::uint32_t, std::uint32_t> next;
  for (const auto& [edge, sides] : sides_of(mesh)) {
    if (sides.size() != 1) continue;
    const Triangle& t = mesh.triangles[sides[0].triangle];
    next[t[(sides[0].corner + 1) % 3]] = t[sides[0].corner];
  }
  std::vector<std::vector<std::uint32_t>> loops;
  while (!next.empty()) {
    std::vector<std::uint32_t> loop;
    for (auto at = next.begin(); at != next.end(); at = next.find(loop.back())) {
      loop.push_back(at->second);
      next.erase(at);
    }
    loops.push_back(std::move(loop));
  }
  return loops;
}

/// Area of the connected part that each vertex is in.
std::vector<double> part_areas(const TriangleMesh& mesh) {
  DisjointSets parts(mesh.positions.size());
  for (const auto& [a, b, c] : mesh.triangles) parts.join(a, b), parts.join(b, c);
  std::vector<double> areas(mesh.positions.size());
  for (const auto& [a, b, c] : mesh.triangles)
    areas[parts.find(a)] +=
        0.5 * length(cross(mesh.positions[b] - mesh.positions[a], mesh.positions[c] - mesh.positions[a]));
  for (std::uint32_t v = 0; v < areas.size(); ++v) areas[v] = areas[parts.find(v)];
  return areas;
}

/// Whether a loop is a hole rather than the rim of an open sheet: the disc of its circumference is a tenth of its part
/// at most. By the isoperimetric inequality no flat sheet's rim is, and that of a bowl or a short tube is not.
bool is_hole(const std::vector<Vec3>& loop, double part_area) {
  double circumference = 0;
  for (std::size_t i = 0; i < loop.size(); ++i) circumference += length(loop[(i + 1) % loop.size()] - loop[i]);
  return circumference * circumference / (4 * kPi) < 0.1 * part_area;
}

void fill_holes(TriangleMesh& mesh, std::size_t largest_hole, RepairReport& report) {
  const std::vector<double> areas = part_areas(mesh);
  std::vector<Vec3> polygon;
  std::vector<std::array<int, 3>> cut;
  for (const std::vector<std::uint32_t>& loop : boundary_loops(mesh)) {
    if (loop.size() < 3 || loop.size() > largest_hole) continue;
    polygon.clear();
    for (const std::uint32_t vertex : loop) polygon.push_back(mesh.positions[vertex]);
    if (!is_hole(polygon, areas[loop[0]])) continue;
    triangulate(polygon, cut);
    for (const auto& [a, b, c] : cut) mesh.triangles.push_back({loop[a], loop[b], loop[c]});
    ++report.filled_holes, report.filling_triangles += cut.size();
  }
}

}  // namespace

RepairReport repair(TriangleMesh& mesh, std::size_t largest_hole) {
  RepairReport report;
  report.turned_triangles = Orienter(mesh).run();
  report.split_vertices = split_sheets(mesh);
  fill_holes(mesh, largest_hole, report);
  return report;
}

}  // namespace redmap
