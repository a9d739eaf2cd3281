// Least squares conformal maps (Levy et al. 2002) as Dirichlet energy less area (Mullen et al. 2008, section 2), and
// the local and global steps of Liu et al. 2008, "A Local/Global Approach to Mesh Parameterization".
#include "surface/chart_flattening.h"

#include <Eigen/Geometry>
#include <Eigen/SparseCholesky>
#include <algorithm>
#include <array>
#include <cmath>

namespace redmap {

namespace {

using Eigen::Vector2d;
using Triplets = std::vector<Eigen::Triplet<double>>;
using Solver = Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>>;

/// A triangle in its own plane, and half the cotangent of the angle opposite each edge k, from corner k to k + 1.
struct FlatTriangle {
  std::array<Vector2d, 3> corner;
  std::array<double, 3> weight{};
};

std::vector<FlatTriangle> flat_triangles(const FlatChart& chart) {
  std::vector<FlatTriangle> triangles;
  triangles.reserve(chart.triangles.size());
  for (const auto& t : chart.triangles) {
    FlatTriangle flat{local_triangle(chart.positions[t[0]], chart.positions[t[1]], chart.positions[t[2]]), {}};
    const double twice_area = flat.corner[1].x() * flat.corner[2].y();
    // Without area it says nothing.
    for (int k = 0; k < 3 && twice_area > 0; ++k) {
      const Vector2d& apex = flat.corner[(k + 2) % 3];
      flat.weight[k] = 0.5 * (flat.corner[k] - apex).dot(flat.corner[(k + 1) % 3] - apex) / twice_area;
    }
    triangles.push_back(flat);
  }
  return triangles;
}

/// Calls `add(a, b, weight)` for the cotangent Laplacian's terms weight * |x_a - x_b|^2.
template <typename Add>
void for_each_edge(const FlatChart& chart, const std::vector<FlatTriangle>& flat, const Add& add) {
  for (std::size_t t = 0; t < flat.size(); ++t)
    for (int k = 0; k < 3; ++k) add(chart.triangles[t][k], chart.triangles[t][(k + 1) % 3], flat[t].weight[k]);
}

/// The vertices that are held fast: two far apart on the boundary.
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

/// A symmetric system where some unknowns are given: they move to the right side.
class PinnedSystem {
 public:
  PinnedSystem(int size, std::vector<std::pair<int, double>> pins) : values_(size, 0.0), column_(size, 0) {
    for (const auto& [unknown, value] : pins) values_[unknown] = value, column_[unknown] = -1;
    for (int& column : column_)
      if (column == 0) column = free_++;
    right_ = Eigen::VectorXd::Zero(free_);
  }
  void add(int row, int column, double value) {
    if (column_[row] < 0) return;
    if (column_[column] < 0)
      right_[column_[row]] -= value * values_[column];
    else
      entries_.emplace_back(column_[row], column_[column], value);
  }
  /// All values, given ones too; empty if there is no solution.
  std::vector<double> solve() {
    Eigen::SparseMatrix<double> matrix(free_, free_);
    matrix.setFromTriplets(entries_.begin(), entries_.end());
    const Solver solver(matrix);
    if (solver.info() != Eigen::Success) return {};
    const Eigen::VectorXd solution = solver.solve(right_);
    if (!solution.allFinite()) return {};
    for (std::size_t i = 0; i < values_.size(); ++i)
      if (column_[i] >= 0) values_[i] = solution[column_[i]];
    return std::move(values_);
  }

 private:
  std::vector<double> values_;
  std::vector<int> column_;
  int free_ = 0;
  Eigen::VectorXd right_;
  Triplets entries_;
};

/// The rotation that best turns the triangle as it is on the surface into the one in the plane.
Eigen::Matrix2d best_rotation(const FlatTriangle& flat, const std::array<Vector2d, 3>& plane) {
  double along = 0, across = 0;
  for (int k = 0; k < 3; ++k) {
    const Vector2d from = flat.corner[k] - flat.corner[(k + 1) % 3], to = plane[k] - plane[(k + 1) % 3];
    along += flat.weight[k] * from.dot(to);
    across += flat.weight[k] * (from.x() * to.y() - from.y() * to.x());
  }
  const double norm = std::hypot(along, across);
  if (!(norm > 0)) return Eigen::Matrix2d::Identity();
  Eigen::Matrix2d rotation;
  rotation << along / norm, -across / norm, across / norm, along / norm;
  return rotation;
}

bool has_flip(const FlatChart& chart) {
  return std::any_of(chart.triangles.begin(), chart.triangles.end(),
                     [&](const auto& t) { return !(plane_area(chart, t) > 0); });
}

/// The right side of the global step: edges as the rotated triangles want them.
Eigen::MatrixX2d wanted_edges(const FlatChart& chart, const std::vector<FlatTriangle>& flat) {
  Eigen::MatrixX2d right = Eigen::MatrixX2d::Zero(static_cast<Eigen::Index>(chart.plane.size()), 2);
  for (std::size_t t = 0; t < flat.size(); ++t) {
    const auto& corner = chart.triangles[t];
    const Eigen::Matrix2d rotation =
        best_rotation(flat[t], {chart.plane[corner[0]], chart.plane[corner[1]], chart.plane[corner[2]]});
    for (int k = 0; k < 3; ++k) {
      const Vector2d edge = flat[t].weight[k] * (rotation * (flat[t].corner[k] - flat[t].corner[(k + 1) % 3]));
      right.row(corner[k]) += edge.transpose();
      right.row(corner[(k + 1) % 3]) -= edge.transpose();
    }
  }
  return right;
}

}  // namespace

bool solve_conformal(FlatChart& chart) {
  const std::vector<std::pair<int, int>>& boundary = chart.boundary;
  if (boundary.size() < 3) return false;
  const auto [pin_0, pin_1] = find_pins(chart, boundary);
  const double distance = (chart.positions[pin_0] - chart.positions[pin_1]).norm();
  if (pin_0 == pin_1 || !(distance > 0)) return false;

  // Unknowns: all x, then all y.
  const int vertices = static_cast<int>(chart.positions.size());
  PinnedSystem system(2 * vertices,
                      {{pin_0, 0.0}, {pin_1, distance}, {vertices + pin_0, 0.0}, {vertices + pin_1, 0.0}});
  for_each_edge(chart, flat_triangles(chart), [&](int a, int b, double weight) {
    for (const int axis : {0, vertices}) {
      system.add(axis + a, axis + a, weight), system.add(axis + b, axis + b, weight);
      system.add(axis + a, axis + b, -weight), system.add(axis + b, axis + a, -weight);
    }
  });
  for (const auto& [a, b] : boundary) {
    system.add(a, vertices + b, -0.5), system.add(vertices + b, a, -0.5);
    system.add(b, vertices + a, 0.5), system.add(vertices + a, b, 0.5);
  }
  const std::vector<double> solution = system.solve();
  if (solution.empty()) return false;
  chart.plane.resize(vertices);
  for (int v = 0; v < vertices; ++v) chart.plane[v] = {solution[v], solution[vertices + v]};
  return true;
}

void relax_isometric(FlatChart& chart) {
  const std::vector<FlatTriangle> flat = flat_triangles(chart);
  const int vertices = static_cast<int>(chart.plane.size());
  Triplets entries;
  for_each_edge(chart, flat, [&](int a, int b, double weight) {
    entries.insert(entries.end(), {{a, a, weight}, {b, b, weight}, {a, b, -weight}, {b, a, -weight}});
  });
  // Moving everything costs nothing: a little weight on one vertex makes the solution unique without changing it.
  entries.emplace_back(0, 0, 1.0);
  Eigen::SparseMatrix<double> matrix(vertices, vertices);
  matrix.setFromTriplets(entries.begin(), entries.end());
  const Solver solver(matrix);
  if (solver.info() != Eigen::Success) return;

  // On the 20k dragon the stretch hardly falls after that.
  constexpr int kSteps = 6;
  for (int step = 0; step < kSteps; ++step) {
    const Eigen::MatrixX2d solution = solver.solve(wanted_edges(chart, flat));
    if (!solution.allFinite()) return;
    std::vector<Vector2d> before = chart.plane;
    for (int v = 0; v < vertices; ++v) chart.plane[v] = solution.row(v).transpose();
    if (has_flip(chart)) {
      chart.plane = std::move(before);
      return;
    }
  }
}

}  // namespace redmap
