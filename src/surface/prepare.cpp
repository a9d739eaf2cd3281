// Welding by a grid, simplification by quadrics (meshoptimizer, after Garland and Heckbert 1997), bounding sphere after
// Ritter 1990.
#include "surface/prepare.h"

#include <meshoptimizer.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <map>
#include <numeric>
#include <unordered_map>

#include "base/error.h"
#include "base/random.h"
#include "surface/face_graph.h"

namespace redmap {

namespace {

struct Bounds {
  Vec3 lower, upper;
};

Bounds bounds(const TriangleMesh& mesh) {
  Bounds b{mesh.positions[0], mesh.positions[0]};
  for (const Vec3 p : mesh.positions)
    for (int axis = 0; axis < 3; ++axis) {
      b.lower[axis] = std::min(b.lower[axis], p[axis]);
      b.upper[axis] = std::max(b.upper[axis], p[axis]);
    }
  return b;
}

std::uint64_t cell_hash(const std::array<std::int64_t, 3>& cell) {
  return hash64(static_cast<std::uint64_t>(cell[0]), static_cast<std::uint64_t>(cell[1]),
                static_cast<std::uint64_t>(cell[2]));
}

/// For every vertex the earlier one it becomes, or itself. `distance` 0 welds what is exactly equal.
std::vector<std::uint32_t> weld_targets(const TriangleMesh& mesh, float distance) {
  const Vec3 lower = bounds(mesh).lower;
  // Cells as wide as the distance: whatever is near enough lies in one of 27.
  const double cell_size = distance > 0 ? distance : 1e-30;
  std::unordered_multimap<std::uint64_t, std::uint32_t> kept;
  std::vector<std::uint32_t> target(mesh.positions.size());
  const auto cell_of = [&](Vec3 p) {
    std::array<std::int64_t, 3> cell;
    for (int axis = 0; axis < 3; ++axis)
      cell[axis] = distance > 0 ? static_cast<std::int64_t>((double(p[axis]) - lower[axis]) / cell_size)
                                : static_cast<std::int64_t>(std::bit_cast<std::int32_t>(p[axis] + 0.0f));
    return cell;
  };
  const int reach = distance > 0 ? 1 : 0;
  for (std::uint32_t i = 0; i < target.size(); ++i) {
    const auto cell = cell_of(mesh.positions[i]);
    target[i] = i;
    for (int neighbour = 0; neighbour < 27; ++neighbour) {
      const std::array<std::int64_t, 3> step{neighbour % 3 - 1, neighbour / 3 % 3 - 1, neighbour / 9 - 1};
      if (std::abs(step[0]) > reach || std::abs(step[1]) > reach || std::abs(step[2]) > reach) continue;
      const auto [begin, end] = kept.equal_range(cell_hash({cell[0] + step[0], cell[1] + step[1], cell[2] + step[2]}));
      for (auto found = begin; found != end; ++found)
        if (length(mesh.positions[found->second] - mesh.positions[i]) <= distance)
          target[i] = std::min(target[i], found->second);
    }
    if (target[i] == i) kept.emplace(cell_hash(cell), i);
  }
  return target;
}

/// Drops vertices that no triangle uses.
void compact(TriangleMesh& mesh) {
  constexpr std::uint32_t kUnused = ~0u;
  std::vector<std::uint32_t> place(mesh.positions.size(), kUnused);
  std::vector<Vec3> positions;
  for (Triangle& t : mesh.triangles)
    for (std::uint32_t& vertex : t) {
      if (place[vertex] == kUnused) {
        place[vertex] = static_cast<std::uint32_t>(positions.size());
        positions.push_back(mesh.positions[vertex]);
      }
      vertex = place[vertex];
    }
  mesh.positions = std::move(positions);
}

/// Drops triangles without area, doubles, and pairs of opposite triangles on the same vertices: simplification folds
/// thin parts to such fins, and a closed mesh stays closed without both.
std::size_t drop_degenerate(TriangleMesh& mesh) {
  const auto winding = [](const Triangle& t) { return (t[0] < t[1]) == ((t[1] < t[2]) == (t[0] < t[2])) ? 1 : -1; };
  const auto sorted = [](Triangle t) {
    std::sort(t.begin(), t.end());
    return t;
  };
  std::map<Triangle, int> winding_sums;
  for (const Triangle& t : mesh.triangles) winding_sums[sorted(t)] += winding(t);
  return std::erase_if(mesh.triangles, [&](const Triangle& t) {
    const Vec3 a = mesh.positions[t[0]], b = mesh.positions[t[1]], c = mesh.positions[t[2]];
    if (!(length(cross(b - a, c - a)) > 0)) return true;
    // The first triangle of the winding that prevails stays, the others go.
    int& left = winding_sums[sorted(t)];
    const bool stays = left * winding(t) > 0;
    if (stays) left = 0;
    return !stays;
  });
}

std::size_t keep_largest_part(TriangleMesh& mesh) {
  const FaceGraph graph = make_face_graph(mesh);
  const std::vector<int> one_label(mesh.triangles.size());
  const std::vector<std::vector<int>> parts = connected_parts(graph, one_label);
  const auto largest =
      std::max_element(parts.begin(), parts.end(), [](const auto& a, const auto& b) { return a.size() < b.size(); });
  std::vector<Triangle> kept;
  for (const int face : *largest) kept.push_back(mesh.triangles[face]);
  const std::size_t dropped = mesh.triangles.size() - kept.size();
  mesh.triangles = std::move(kept);
  return dropped;
}

void simplify(TriangleMesh& mesh, std::size_t triangles) {
  std::vector<unsigned int> indices(3 * mesh.triangles.size());
  // Any error is welcome that leads to the number asked for: 1 is the size of the mesh.
  constexpr float kAnyError = 1;
  const std::size_t count =
      meshopt_simplify(indices.data(), mesh.triangles.data()->data(), indices.size(), &mesh.positions.data()->x,
                       mesh.positions.size(), sizeof(Vec3), 3 * triangles, kAnyError, 0, nullptr);
  mesh.triangles.resize(count / 3);
  for (std::size_t i = 0; i < count; ++i) mesh.triangles[i / 3][i % 3] = indices[i];
}

struct Sphere {
  Vec3 centre;
  float radius;
};

/// Ritter's sphere, at most some percent larger than the smallest.
Sphere bounding_sphere(const TriangleMesh& mesh) {
  const auto farthest = [&](Vec3 from) {
    return *std::max_element(mesh.positions.begin(), mesh.positions.end(),
                             [&](Vec3 a, Vec3 b) { return length(a - from) < length(b - from); });
  };
  const Vec3 a = farthest(mesh.positions[0]), b = farthest(a);
  Sphere sphere{lerp(a, b, 0.5f), length(b - a) / 2};
  for (const Vec3 p : mesh.positions) {
    const float distance = length(p - sphere.centre);
    if (distance <= sphere.radius) continue;
    const float radius = (sphere.radius + distance) / 2;
    sphere.centre += (p - sphere.centre) * ((distance - radius) / distance);
    sphere.radius = radius;
  }
  return sphere;
}

void move_to_unit_sphere(TriangleMesh& mesh) {
  const Sphere sphere = bounding_sphere(mesh);
  for (Vec3& p : mesh.positions) p = (p - sphere.centre) / sphere.radius;
  // What Ritter's sphere is too large by is made good, so that the farthest vertex has length 1.
  float largest = 0;
  for (const Vec3 p : mesh.positions) largest = std::max(largest, length(p));
  for (Vec3& p : mesh.positions) p = p / largest;
}

void count_edges(const TriangleMesh& mesh, PrepareReport& report) {
  // Triangles along each edge, and those along it upwards.
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::array<int, 2>> edges;
  for (const Triangle& t : mesh.triangles)
    for (int k = 0; k < 3; ++k) {
      const std::uint32_t a = t[k], b = t[(k + 1) % 3];
      auto& [all, upwards] = edges[std::minmax(a, b)];
      ++all, upwards += a < b;
    }
  for (const auto& [edge, counts] : edges) {
    report.boundary_edges += counts[0] == 1;
    report.non_manifold_edges += counts[0] > 2 || (counts[0] == 2 && counts[1] != 1);
  }
}

}  // namespace

TriangleMesh subdivide_loop(const TriangleMesh& mesh) {
  struct Edge {
    std::uint32_t middle = 0;
    int triangles = 0;
    Vec3 opposite;  // sum over the triangles
  };
  std::map<std::pair<std::uint32_t, std::uint32_t>, Edge> edges;
  for (const Triangle& t : mesh.triangles)
    for (int k = 0; k < 3; ++k) {
      Edge& edge = edges[std::minmax({t[k], t[(k + 1) % 3]})];
      ++edge.triangles;
      edge.opposite += mesh.positions[t[(k + 2) % 3]];
    }

  // Old vertices: neighbours inside, only the boundary's own neighbours on it.
  struct Ring {
    Vec3 inner, boundary;
    int inner_count = 0, boundary_count = 0;
  };
  std::vector<Ring> rings(mesh.positions.size());
  TriangleMesh finer;
  finer.positions.resize(mesh.positions.size());
  for (auto& [ends, edge] : edges) {
    const Vec3 a = mesh.positions[ends.first], b = mesh.positions[ends.second];
    const bool inside = edge.triangles == 2;
    edge.middle = static_cast<std::uint32_t>(finer.positions.size());
    finer.positions.push_back(inside ? (a + b) * 0.375f + edge.opposite * 0.125f : (a + b) * 0.5f);
    for (const auto& [from, to] : {std::pair{ends.first, b}, std::pair{ends.second, a}}) {
      rings[from].inner += to, ++rings[from].inner_count;
      if (!inside) rings[from].boundary += to, ++rings[from].boundary_count;
    }
  }
  for (std::size_t v = 0; v < rings.size(); ++v) {
    const Ring& ring = rings[v];
    const Vec3 p = mesh.positions[v];
    if (ring.boundary_count == 2) {
      finer.positions[v] = p * 0.75f + ring.boundary * 0.125f;
    } else if (ring.boundary_count > 0 || ring.inner_count < 3) {
      finer.positions[v] = p;
    } else {
      // Loop's weight for a vertex of n neighbours.
      const float n = static_cast<float>(ring.inner_count), c = 0.375f + 0.25f * std::cos(2 * kPi / n);
      const float weight = (0.625f - c * c) / n;
      finer.positions[v] = p * (1 - n * weight) + ring.inner * weight;
    }
  }
  for (const auto& [a, b, c] : mesh.triangles) {
    const auto middle = [&](std::uint32_t i, std::uint32_t j) { return edges.at(std::minmax(i, j)).middle; };
    const std::uint32_t ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
    finer.triangles.insert(finer.triangles.end(), {{a, ab, ca}, {b, bc, ab}, {c, ca, bc}, {ab, bc, ca}});
  }
  return finer;
}

PrepareReport prepare(TriangleMesh& mesh, const PrepareOptions& options) {
  if (mesh.triangles.empty()) throw Error("mesh: expected at least one triangle, found none");
  PrepareReport report;
  mesh.normals.clear(), mesh.normal_triangles.clear(), mesh.uv.clear(), mesh.uv_triangles.clear();
  const Bounds box = bounds(mesh);
  const std::vector<std::uint32_t> target = weld_targets(mesh, options.weld_distance * length(box.upper - box.lower));
  for (std::size_t i = 0; i < target.size(); ++i) report.welded_vertices += target[i] != i;
  for (Triangle& t : mesh.triangles)
    for (std::uint32_t& vertex : t) vertex = target[vertex];
  report.dropped_triangles = drop_degenerate(mesh);
  if (mesh.triangles.empty()) throw Error("mesh: expected triangles of three different places, found none");
  if (options.largest_part) report.dropped_triangles += keep_largest_part(mesh);
  if (options.repair) report.repair = repair(mesh);
  for (compact(mesh); mesh.triangles.size() < options.triangles; ++report.subdivisions) mesh = subdivide_loop(mesh);
  if (options.triangles > 0 && mesh.triangles.size() > options.triangles) {
    simplify(mesh, options.triangles);
    report.dropped_triangles += drop_degenerate(mesh);
    if (mesh.triangles.empty()) throw Error("mesh: cannot be simplified to {} triangles", options.triangles);
    compact(mesh);
  }
  if (options.unit_sphere) move_to_unit_sphere(mesh);
  count_edges(mesh, report);
  report.vertices = mesh.positions.size(), report.triangles = mesh.triangles.size();
  return report;
}

}  // namespace redmap
