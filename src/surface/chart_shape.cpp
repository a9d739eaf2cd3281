// Cells under an outline: those that its edges touch, by separating axes, and those whose centre is inside.
#include "surface/chart_shape.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace redmap {

namespace {

using Eigen::Vector2d;

/// Sets every cell whose square, grown by the gutter, touches the edge.
void cover_edge(const Vector2d& a, const Vector2d& b, const PackingGrid& grid, CellBitmap& cells) {
  const double cell = grid.cell_texels, grow = grid.gutter_texels;
  const Vector2d lower = a.cwiseMin(b), upper = a.cwiseMax(b), along = b - a;
  const auto cell_at = [&](double value) { return std::max(0, static_cast<int>(std::floor(value / cell))); };
  const int x_end = std::min(cells.width() - 1, cell_at(upper.x() + grow));
  const int y_end = std::min(cells.height() - 1, cell_at(upper.y() + grow));
  const double reach = (cell / 2 + grow) * (std::abs(along.x()) + std::abs(along.y()));
  for (int y = cell_at(lower.y() - grow); y <= y_end; ++y)
    for (int x = cell_at(lower.x() - grow); x <= x_end; ++x) {
      const Vector2d to_centre = Vector2d((x + 0.5) * cell, (y + 0.5) * cell) - a;
      if (std::abs(along.x() * to_centre.y() - along.y() * to_centre.x()) <= reach) cells.set(x, y);
    }
}

/// Sets every cell whose centre is inside, row by row, between every other crossing.
void cover_inside(const Outline& outline, double cell, CellBitmap& cells) {
  std::vector<std::vector<double>> crossings(cells.height());
  for (const auto& [a, b] : outline) {
    const int first = std::max(0, static_cast<int>(std::ceil(std::min(a.y(), b.y()) / cell - 0.5)));
    for (int y = first; y < cells.height() && (y + 0.5) * cell <= std::max(a.y(), b.y()); ++y) {
      const double centre = (y + 0.5) * cell;
      if ((a.y() <= centre) != (b.y() <= centre))
        crossings[y].push_back(a.x() + (b.x() - a.x()) * (centre - a.y()) / (b.y() - a.y()));
    }
  }
  for (int y = 0; y < cells.height(); ++y) {
    std::sort(crossings[y].begin(), crossings[y].end());
    for (std::size_t i = 0; i + 1 < crossings[y].size(); i += 2) {
      const int first = std::max(0, static_cast<int>(std::ceil(crossings[y][i] / cell - 0.5)));
      for (int x = first; x < cells.width() && (x + 0.5) * cell <= crossings[y][i + 1]; ++x) cells.set(x, y);
    }
  }
}

void summarize(ChartShape& shape) {
  // With 16, hardly a place gets past them that does not fit.
  constexpr std::size_t kSamples = 16;
  std::vector<Cell> cells;
  double rows = 0;
  for (int y = 0; y < shape.cells.height(); ++y)
    for (int x = 0; x < shape.cells.width(); ++x)
      if (shape.cells.at(x, y)) cells.push_back({x, y}), rows += y;
  const std::size_t count = std::min(kSamples, cells.size());
  for (std::size_t i = 0; i < count; ++i) shape.samples.push_back(cells[i * cells.size() / count]);
  shape.centre_row = rows / static_cast<double>(std::max<std::size_t>(1, cells.size()));
}

}  // namespace

Outline outline_of(const FlatChart& chart) {
  Outline outline;
  for (const auto& [a, b] : chart.boundary) outline.push_back({chart.plane[a], chart.plane[b]});
  return outline;
}

ChartShape make_shape(const Outline& outline, double angle, double scale, const PackingGrid& grid) {
  const Eigen::Matrix2d turn = Eigen::Rotation2Dd(angle).toRotationMatrix() * scale;
  Outline turned = outline;
  Vector2d lower = turn * outline.front()[0], upper = lower;
  for (auto& edge : turned)
    for (Vector2d& end : edge) {
      end = turn * end;
      lower = lower.cwiseMin(end), upper = upper.cwiseMax(end);
    }

  ChartShape shape;
  shape.angle = angle;
  shape.origin = Vector2d(grid.gutter_texels, grid.gutter_texels) - lower;
  const Vector2d cells_across = ((upper - lower).array() + 2 * grid.gutter_texels) / grid.cell_texels;
  if (!(cells_across.maxCoeff() < grid.cells)) return shape;
  shape.cells = CellBitmap(static_cast<int>(cells_across.x()) + 1, static_cast<int>(cells_across.y()) + 1);
  for (auto& [a, b] : turned) {
    a += shape.origin, b += shape.origin;
    cover_edge(a, b, grid, shape.cells);
  }
  cover_inside(turned, grid.cell_texels, shape.cells);
  summarize(shape);
  return shape;
}

}  // namespace redmap
