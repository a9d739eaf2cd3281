// Charts are placed one after the other where their centre comes lowest, in many directions; those that find no place
// are tried earlier the next time ("squeaky wheel" optimization, Joslin and Clements 1999). Binary search over the
// scale.
#include "surface/chart_packing.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <atomic>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <numeric>

#include "base/parallel.h"
#include "surface/chart_shape.h"

namespace redmap {

namespace {

// Directions a chart is tried in. On the 10k bunny, cut into 40 charts, 4, 8, 16, 32 and 64 of them fill 60, 60, 64, 66
// and 66 %; with hundreds of charts the small ones fill the holes anyway, and each direction costs time.
constexpr int kDirections = 32, kDirectionsOfMany = 8;
constexpr std::size_t kManyCharts = 300;

/// Placements of single shapes that are spent on one scale, beyond the first try: 10 more tries for 46 charts.
constexpr std::size_t kPlacementsPerScale = 15000;

/// 10 halvings: the scale is within a thousandth of the largest that was found.
constexpr int kHalvings = 10;

/// All directions of all charts at one scale: [chart][direction].
using Shapes = std::vector<std::vector<ChartShape>>;

struct Fit {
  double height = std::numeric_limits<double>::infinity();  ///< of the centre, in cells
  int x = 0, y = 0;
};

/// The lowest, then leftmost place where `shape` collides with nothing of `atlas`. Samples rule out 64 places at a
/// time. Gives up where the centre would be above `limit`, which may fall meanwhile.
Fit find_fit(const CellBitmap& atlas, const ChartShape& shape, const std::atomic<double>& limit) {
  const CellBitmap& cells = shape.cells;
  for (int y = 0; y + cells.height() <= atlas.height() && y + shape.centre_row <= limit; ++y)
    for (int x = 0; x + cells.width() <= atlas.width(); x += 64) {
      std::uint64_t possible = ~std::uint64_t{0};
      for (std::size_t i = 0; i < shape.samples.size() && possible; ++i)
        possible &= ~atlas.bits_from(x + shape.samples[i].x, y + shape.samples[i].y);
      for (; possible; possible &= possible - 1) {
        const int column = x + std::countr_zero(possible);
        if (column + cells.width() > atlas.width()) break;
        if (!atlas.collides(cells, column, y)) return {y + shape.centre_row, column, y};
      }
    }
  return {};
}

class Packer {
 public:
  Packer(std::span<const FlatChart> charts, const PackingGrid& grid)
      : grid_(grid), directions_(charts.size() < kManyCharts ? kDirections : kDirectionsOfMany), order_(charts.size()) {
    std::vector<double> sizes;
    for (const FlatChart& chart : charts) {
      outlines_.push_back(outline_of(chart));
      Eigen::Vector2d size = Eigen::Vector2d::Zero();
      for (const Eigen::Vector2d& p : chart.plane) size = size.cwiseMax(p);
      sizes.push_back(size.maxCoeff());
    }
    std::iota(order_.begin(), order_.end(), std::size_t{0});
    std::stable_sort(order_.begin(), order_.end(), [&](std::size_t a, std::size_t b) { return sizes[a] > sizes[b]; });
  }

  /// Remembers the order that led to a fit.
  std::optional<std::vector<Placement>> try_scale(double scale) {
    const Shapes shapes = shapes_at(scale);
    std::vector<std::size_t> order = order_;
    const std::size_t tries = 1 + kPlacementsPerScale / (order.size() * directions_);
    for (std::size_t i = 0; i < tries; ++i) {
      std::vector<Placement> placements(order.size());
      const std::vector<std::size_t> left = pack(shapes, order, placements);
      if (left.empty()) {
        order_ = std::move(order);
        return placements;
      }
      // So many will not be saved by another order.
      if (left.size() > order.size() / 3) return std::nullopt;
      move_forward(left, order);
    }
    return std::nullopt;
  }

 private:
  Shapes shapes_at(double scale) const {
    Shapes shapes(outlines_.size(), std::vector<ChartShape>(directions_));
    parallel_for(outlines_.size(), [&](std::size_t chart) {
      for (int d = 0; d < directions_; ++d)
        shapes[chart][d] = make_shape(outlines_[chart], 2 * std::numbers::pi * d / directions_, scale, grid_);
    });
    return shapes;
  }

  /// Places charts in the order given. Returns those that found no place.
  std::vector<std::size_t> pack(const Shapes& shapes, const std::vector<std::size_t>& order,
                                std::vector<Placement>& placements) const {
    CellBitmap atlas(grid_.cells, grid_.cells);
    std::vector<std::size_t> left;
    std::vector<Fit> fits(directions_);
    for (const std::size_t chart : order) {
      // Whatever the limit cuts short is worse than the best, so that the order of the threads does not matter.
      std::atomic<double> limit = std::numeric_limits<double>::max();
      parallel_for(directions_, [&](std::size_t d) {
        fits[d] = shapes[chart][d].empty() ? Fit{} : find_fit(atlas, shapes[chart][d], limit);
        for (double now = limit; fits[d].height < now && !limit.compare_exchange_weak(now, fits[d].height);) {
        }
      });
      const auto best = std::min_element(fits.begin(), fits.end(), [](const Fit& a, const Fit& b) {
        return std::pair(a.height, a.x) < std::pair(b.height, b.x);
      });
      if (!std::isfinite(best->height)) {
        left.push_back(chart);
        continue;
      }
      const ChartShape& shape = shapes[chart][best - fits.begin()];
      atlas.add(shape.cells, best->x, best->y);
      placements[chart] = {shape.angle, shape.origin + Eigen::Vector2d(best->x, best->y) * grid_.cell_texels};
    }
    return left;
  }

  /// Each of `charts` gets half way to the front.
  static void move_forward(const std::vector<std::size_t>& charts, std::vector<std::size_t>& order) {
    for (const std::size_t chart : charts) {
      const auto now = std::find(order.begin(), order.end(), chart);
      std::rotate(order.begin() + (now - order.begin()) / 2, now, now + 1);
    }
  }

  PackingGrid grid_;
  int directions_;
  std::vector<Outline> outlines_;
  std::vector<std::size_t> order_;  ///< largest first, to begin with
};

}  // namespace

std::optional<Packing> pack_charts(std::span<const FlatChart> charts, int resolution, int cell_texels,
                                   int gutter_texels) {
  Packer packer(charts, {resolution / cell_texels, double(cell_texels), double(gutter_texels)});
  double area = 0;
  for (const FlatChart& chart : charts)
    for (const auto& triangle : chart.triangles) area += plane_area(chart, triangle);
  double low = 0, high = resolution / std::sqrt(area);
  std::optional<Packing> best;
  for (int i = 0; i < kHalvings; ++i) {
    const double scale = (low + high) / 2;
    if (auto placements = packer.try_scale(scale)) {
      best = Packing{scale, std::move(*placements)};
      low = scale;
    } else {
      high = scale;
    }
  }
  return best;
}

Eigen::Vector2d place(const Placement& placement, double scale, const Eigen::Vector2d& point) {
  return Eigen::Rotation2Dd(placement.angle) * point * scale + placement.offset;
}

}  // namespace redmap
