// Cutting, flattening (least squares conformal maps, Levy et al. 2002) and checking of one chart.
#include "surface/flat_chart.h"

#include <Eigen/Geometry>
#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

namespace redmap {

namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

double cross2(const Vector2d& a, const Vector2d& b) { return a.x() * b.y() - a.y() * b.x(); }

/// Edges with a triangle on one side only, in the triangle's direction.
std::vector<std::pair<int, int>> boundary_edges(const FlatChart& chart) {
  std::vector<std::array<int, 4>> edges;  // low, high, from, to
  for (const auto& t : chart.triangles)
    for (int k = 0; k < 3; ++k) {
      const int a = t[k], b = t[(k + 1) % 3];
      edges.push_back({std::min(a, b), std::max(a, b), a, b});
    }
  std::sort(edges.begin(), edges.end());
  std::vector<std::pair<int, int>> boundary;
  for (std::size_t i = 0; i < edges.size(); ++i) {
    const auto same = [&](std::size_t j) {
      return j < edges.size() && edges[j][0] == edges[i][0] && edges[j][1] == edges[i][1];
    };
    if (!same(i + 1) && !(i > 0 && same(i - 1))) boundary.emplace_back(edges[i][2], edges[i][3]);
  }
  return boundary;
}

/// A triangle in its own plane: corner 0 at the origin, corner 1 at (x1, 0), corner 2 at (x2, y2).
struct LocalTriangle {
  double x1, x2, y2;
};

LocalTriangle local_triangle(const Vector3d& a, const Vector3d& b, const Vector3d& c) {
  const double x1 = (b - a).norm();
  const Vector3d x = (b - a) / x1;
  return {x1, x.dot(c - a), x.cross(c - a).norm()};
}

/// The vertices that LSCM holds fast: two far apart on the boundary.
std::pair<int, int> find_pins(const FlatChart& chart, const std::vector<std::pair<int, int>>& boundary) {
  const auto farthest = [&](int from) {
    return std::max_element(boundary.begin(), boundary.end(),
                            [&](const auto& a, const auto& b) {
                              return (chart.positions[a.first] - chart.positions[from]).squaredNorm() <
                                     (chart.positions[b.first] - chart.positions[from]).squaredNorm();
                            })
        ->first;
  };
  const int first = farthest(boundary.front().first);
  return {first, farthest(first)};
}

bool solve_conformal(FlatChart& chart) {
  const std::vector<std::pair<int, int>> boundary = boundary_edges(chart);
  if (boundary.size() < 3) return false;
  const auto [pin_0, pin_1] = find_pins(chart, boundary);
  const double distance = (chart.positions[pin_0] - chart.positions[pin_1]).norm();
  if (pin_0 == pin_1 || !(distance > 0)) return false;
  const int vertices = static_cast<int>(chart.positions.size()), triangles = static_cast<int>(chart.triangles.size());
  const int free = vertices - 2;
  std::vector<int> column(vertices, -1);
  for (int v = 0, next = 0; v < vertices; ++v)
    if (v != pin_0 && v != pin_1) column[v] = next++;

  // Two rows a triangle: the real and imaginary part of sum_j W_j U_j / sqrt(2 area) = 0 (equation 6 there).
  std::vector<Eigen::Triplet<double>> entries;
  Eigen::VectorXd right = Eigen::VectorXd::Zero(2 * triangles);
  for (int t = 0; t < triangles; ++t) {
    const auto& corners = chart.triangles[t];
    const LocalTriangle local =
        local_triangle(chart.positions[corners[0]], chart.positions[corners[1]], chart.positions[corners[2]]);
    if (!(local.x1 > 0 && local.y2 > 0)) continue;
    const double scale = 1 / std::sqrt(local.x1 * local.y2);
    const Vector2d weights[3] = {{local.x2 - local.x1, local.y2}, {-local.x2, -local.y2}, {local.x1, 0}};
    for (int k = 0; k < 3; ++k) {
      const double re = weights[k].x() * scale, im = weights[k].y() * scale;
      const int c = column[corners[k]];
      if (c >= 0) {
        entries.insert(entries.end(),
                       {{t, c, re}, {t, free + c, -im}, {triangles + t, c, im}, {triangles + t, free + c, re}});
      } else if (corners[k] == pin_1) {
        right[t] -= re * distance, right[triangles + t] -= im * distance;
      }
    }
  }
  Eigen::SparseMatrix<double> matrix(2 * triangles, 2 * free);
  matrix.setFromTriplets(entries.begin(), entries.end());
  const Eigen::SparseMatrix<double> normal_matrix = matrix.transpose() * matrix;
  const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> solver(normal_matrix);
  if (solver.info() != Eigen::Success) return false;
  const Eigen::VectorXd solution = solver.solve(matrix.transpose() * right);
  if (!solution.allFinite()) return false;
  chart.plane.assign(vertices, Vector2d::Zero());
  chart.plane[pin_1] = {distance, 0};
  for (int v = 0; v < vertices; ++v)
    if (column[v] >= 0) chart.plane[v] = {solution[column[v]], solution[free + column[v]]};
  return true;
}

double plane_area(const FlatChart& chart, const std::array<int, 3>& t) {
  return 0.5 * cross2(chart.plane[t[1]] - chart.plane[t[0]], chart.plane[t[2]] - chart.plane[t[0]]);
}

struct Rectangle {
  Vector2d lower, upper;
  double area() const { return (upper - lower).prod(); }
};

Rectangle bounds_turned(const FlatChart& chart, const Eigen::Rotation2Dd& turn) {
  Rectangle r{turn * chart.plane[0], turn * chart.plane[0]};
  for (const Vector2d& p : chart.plane) {
    const Vector2d q = turn * p;
    r.lower = r.lower.cwiseMin(q), r.upper = r.upper.cwiseMax(q);
  }
  return r;
}

/// True area, the smallest of 30 rectangles, corner at the origin. False if nothing has area.
bool normalize_plane(FlatChart& chart) {
  double area = 0;
  for (const auto& t : chart.triangles) area += plane_area(chart, t);
  if (!(area > 0)) return false;
  const double scale = std::sqrt(chart.area / area);
  for (Vector2d& p : chart.plane) p *= scale;
  constexpr int kTurns = 30;  // 3 degrees apart over a quarter turn: within 1 % of the smallest rectangle
  Eigen::Rotation2Dd best(0);
  for (int i = 1; i < kTurns; ++i) {
    const Eigen::Rotation2Dd turn(std::numbers::pi / 2 * i / kTurns);
    if (bounds_turned(chart, turn).area() < bounds_turned(chart, best).area()) best = turn;
  }
  const Vector2d lower = bounds_turned(chart, best).lower;
  for (Vector2d& p : chart.plane) p = best * p - lower;
  return true;
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
  std::vector<std::pair<int, int>> edges = boundary_edges(chart);
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

/// The mean of the squared singular values of the map from the plane to the surface (Sander et al. 2001).
double squared_l2_stretch(const FlatChart& chart, const std::array<int, 3>& t, double twice_area) {
  const Vector2d &p = chart.plane[t[0]], &q = chart.plane[t[1]], &r = chart.plane[t[2]];
  const Vector3d &a = chart.positions[t[0]], &b = chart.positions[t[1]], &c = chart.positions[t[2]];
  const Vector3d along_s = (a * (q.y() - r.y()) + b * (r.y() - p.y()) + c * (p.y() - q.y())) / twice_area;
  const Vector3d along_t = (a * (r.x() - q.x()) + b * (p.x() - r.x()) + c * (q.x() - p.x())) / twice_area;
  return 0.5 * (along_s.squaredNorm() + along_t.squaredNorm());
}

}  // namespace

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
  return chart;
}

bool is_disk(const FlatChart& chart) {
  // Euler's characteristic of a connected surface with boundary is 1 for the disk alone.
  const auto boundary = static_cast<int>(boundary_edges(chart).size());
  const auto faces = static_cast<int>(chart.triangles.size());
  const int edges = (3 * faces + boundary) / 2;
  return static_cast<int>(chart.positions.size()) - edges + faces == 1;
}

bool flatten(FlatChart& chart) {
  if (chart.triangles.size() == 1) {
    const LocalTriangle local = local_triangle(chart.positions[0], chart.positions[1], chart.positions[2]);
    chart.plane = {{0, 0}, {local.x1, 0}, {local.x2, local.y2}};
  } else if (!solve_conformal(chart)) {
    return false;
  }
  return normalize_plane(chart);
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
