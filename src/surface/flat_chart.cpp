// Cutting, flattening and checking of one chart.
#include "surface/flat_chart.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "surface/chart_flattening.h"

namespace redmap {

namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

double cross2(const Vector2d& a, const Vector2d& b) { return a.x() * b.y() - a.y() * b.x(); }

struct Rectangle {
  Vector2d lower, upper;
  double area() const { return (upper - lower).prod(); }
};

Rectangle bounds_turned(const FlatChart& chart, const Eigen::Matrix2d& turn) {
  Rectangle r{turn * chart.plane[0], turn * chart.plane[0]};
  for (const Vector2d& p : chart.plane) {
    const Vector2d q = turn * p;
    r.lower = r.lower.cwiseMin(q), r.upper = r.upper.cwiseMax(q);
  }
  return r;
}

/// False if nothing has area.
bool scale_to_area(FlatChart& chart) {
  double area = 0;
  for (const auto& t : chart.triangles) area += plane_area(chart, t);
  if (!(area > 0)) return false;
  const double scale = std::sqrt(chart.area / area);
  for (Vector2d& p : chart.plane) p *= scale;
  return true;
}

/// The smallest of 30 rectangles, corner at the origin.
void turn_to_smallest_rectangle(FlatChart& chart) {
  constexpr int kTurns = 30;  // 3 degrees apart over a quarter turn: within 1 % of the smallest rectangle
  Eigen::Matrix2d best = Eigen::Matrix2d::Identity();
  Rectangle smallest = bounds_turned(chart, best);
  for (int i = 1; i < kTurns; ++i) {
    const Eigen::Matrix2d turn = Eigen::Rotation2Dd(std::numbers::pi / 2 * i / kTurns).toRotationMatrix();
    const Rectangle turned = bounds_turned(chart, turn);
    if (turned.area() < smallest.area()) best = turn, smallest = turned;
  }
  for (Vector2d& p : chart.plane) p = best * p - smallest.lower;
}

/// Whether the segments (a, b) and (c, d) have a point in common.
bool touch(const Vector2d& a, const Vector2d& b, const Vector2d& c, const Vector2d& d) {
  if (std::max(a.x(), b.x()) < std::min(c.x(), d.x()) || std::max(c.x(), d.x()) < std::min(a.x(), b.x()) ||
      std::max(a.y(), b.y()) < std::min(c.y(), d.y()) || std::max(c.y(), d.y()) < std::min(a.y(), b.y()))
    return false;
  const double c_side = cross2(b - a, c - a), d_side = cross2(b - a, d - a);
  const double a_side = cross2(d - c, a - c), b_side = cross2(d - c, b - c);
  return c_side * d_side <= 0 && a_side * b_side <= 0;
}

/// A disk whose triangles all keep their orientation overlaps itself only if its boundary does. Sweeps along x.
bool boundary_crosses_itself(const FlatChart& chart) {
  std::vector<std::pair<int, int>> edges = chart.boundary;
  const auto left = [&](const auto& e) { return std::min(chart.plane[e.first].x(), chart.plane[e.second].x()); };
  const auto right = [&](const auto& e) { return std::max(chart.plane[e.first].x(), chart.plane[e.second].x()); };
  std::sort(edges.begin(), edges.end(), [&](const auto& a, const auto& b) { return left(a) < left(b); });
  for (std::size_t i = 0; i < edges.size(); ++i)
    for (std::size_t j = i + 1; j < edges.size() && left(edges[j]) <= right(edges[i]); ++j) {
      const auto [a, b] = edges[i];
      const auto [c, d] = edges[j];
      if (a == c || a == d || b == c || b == d) continue;
      if (touch(chart.plane[a], chart.plane[b], chart.plane[c], chart.plane[d])) return true;
    }
  return false;
}

/// Edges without a neighbour, ordered by their vertices.
void find_boundary(const std::vector<std::array<int, 3>>& neighbours, FlatChart& chart) {
  for (std::size_t f = 0; f < neighbours.size(); ++f)
    for (int k = 0; k < 3; ++k)
      if (neighbours[f][k] < 0) chart.boundary.emplace_back(chart.triangles[f][k], chart.triangles[f][(k + 1) % 3]);
  std::sort(chart.boundary.begin(), chart.boundary.end(), [](const auto& a, const auto& b) {
    return std::minmax(a.first, a.second) < std::minmax(b.first, b.second);
  });
}

/// The mean of the squared singular values of the map from the plane to the surface (Sander et al. 2001).
double squared_l2_stretch(const FlatChart& chart, const std::array<int, 3>& t, double twice_area) {
  const Vector2d &p = chart.plane[t[0]], &q = chart.plane[t[1]], &r = chart.plane[t[2]];
  const Vector3d &a = chart.positions[t[0]], &b = chart.positions[t[1]], &c = chart.positions[t[2]];
  const Vector3d along_s = (a * (q.y() - r.y()) + b * (r.y() - p.y()) + c * (p.y() - q.y())) / twice_area;
  const Vector3d along_t = (a * (r.x() - q.x()) + b * (p.x() - r.x()) + c * (q.x() - p.x())) / twice_area;
  return 0.5 * (along_s.squaredNorm() + along_t.squaredNorm());
}

}  // namespace

std::array<Vector2d, 3> local_triangle(const Vector3d& a, const Vector3d& b, const Vector3d& c) {
  const double x1 = (b - a).norm();
  if (!(x1 > 0)) return {Vector2d::Zero(), Vector2d::Zero(), Vector2d::Zero()};
  const Vector3d x = (b - a) / x1;
  return {Vector2d::Zero(), Vector2d(x1, 0), Vector2d(x.dot(c - a), x.cross(c - a).norm())};
}

double plane_area(const FlatChart& chart, const std::array<int, 3>& t) {
  return 0.5 * cross2(chart.plane[t[1]] - chart.plane[t[0]], chart.plane[t[2]] - chart.plane[t[0]]);
}

FlatChart cut_chart(const TriangleMesh& mesh, const FaceGraph& graph, std::vector<int> faces) {
  FlatChart chart;
  chart.faces = std::move(faces);
  const int count = static_cast<int>(chart.faces.size());
  const std::vector<std::array<int, 3>> neighbours = subgraph(graph, chart.faces).neighbours;
  // Corners on both sides of an inner edge are one vertex; opposite directions pair start with end.
  std::vector<int> parent(3 * count);
  std::iota(parent.begin(), parent.end(), 0);
  const auto root = [&](int i) {
    while (parent[i] != i) i = parent[i] = parent[parent[i]];
    return i;
  };
  for (int f = 0; f < count; ++f)
    for (int k = 0; k < 3; ++k) {
      const int other = neighbours[f][k];
      if (other < f) continue;
      const auto& back = neighbours[other];
      for (int l = 0; l < 3; ++l)
        if (back[l] == f && mesh.positions[mesh.triangles[chart.faces[other]][l]] ==
                                mesh.positions[mesh.triangles[chart.faces[f]][(k + 1) % 3]]) {
          parent[root(3 * f + k)] = root(3 * other + (l + 1) % 3);
          parent[root(3 * f + (k + 1) % 3)] = root(3 * other + l);
        }
    }
  std::vector<int> vertex_of_root(3 * count, -1);
  chart.triangles.resize(count);
  for (int f = 0; f < count; ++f) {
    chart.area += graph.areas[chart.faces[f]];
    for (int k = 0; k < 3; ++k) {
      int& vertex = vertex_of_root[root(3 * f + k)];
      if (vertex < 0) {
        vertex = static_cast<int>(chart.positions.size());
        const Vec3 p = mesh.positions[mesh.triangles[chart.faces[f]][k]];
        chart.positions.emplace_back(p.x, p.y, p.z);
      }
      chart.triangles[f][k] = vertex;
    }
  }
  find_boundary(neighbours, chart);
  return chart;
}

bool is_disk(const FlatChart& chart) {
  // Euler's characteristic of a connected surface with boundary is 1 for the disk alone.
  const auto boundary = static_cast<int>(chart.boundary.size());
  const auto faces = static_cast<int>(chart.triangles.size());
  const int edges = (3 * faces + boundary) / 2;
  return static_cast<int>(chart.positions.size()) - edges + faces == 1;
}

bool flatten(FlatChart& chart) {
  if (chart.triangles.size() == 1) {
    const auto& [a, b, c] = local_triangle(chart.positions[0], chart.positions[1], chart.positions[2]);
    chart.plane = {a, b, c};
  } else {
    if (!solve_conformal(chart) || !scale_to_area(chart)) return false;
    relax_isometric(chart);
  }
  if (!scale_to_area(chart)) return false;
  turn_to_smallest_rectangle(chart);
  return true;
}

bool is_sound(FlatChart& chart, double max_l2_stretch) {
  chart.stretch_times_area = 0;
  for (std::size_t f = 0; f < chart.triangles.size(); ++f) {
    const auto& t = chart.triangles[f];
    const double area = plane_area(chart, t);
    if (!(area > 0)) return false;
    const double surface_area =
        0.5 *
        (chart.positions[t[1]] - chart.positions[t[0]]).cross(chart.positions[t[2]] - chart.positions[t[0]]).norm();
    chart.stretch_times_area += squared_l2_stretch(chart, t, 2 * area) * surface_area;
  }
  return chart.stretch_times_area <= max_l2_stretch * max_l2_stretch * chart.area && !boundary_crosses_itself(chart);
}

}  // namespace redmap
