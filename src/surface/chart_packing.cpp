// First fit from the bottom left, largest chart first, in four orientations; binary search over the scale. Bitmaps are
// rows of 64-bit words, so that a row of a chart is compared with a row of the atlas in a few instructions.
#include "surface/chart_packing.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <numeric>

#include "base/parallel.h"

namespace redmap {

namespace {

using Eigen::Vector2d;

/// Rows of bits, each in whole words and one word of zeros.
class Bitmap {
 public:
  Bitmap(int width, int height)
      : width_(width), height_(height), words_(width / 64 + 2), bits_(std::size_t(words_) * height) {}

  int width() const { return width_; }
  int height() const { return height_; }
  void set(int x, int y) { row(y)[x / 64] |= std::uint64_t{1} << (x % 64); }
  bool at(int x, int y) const { return row(y)[x / 64] >> (x % 64) & 1; }

  /// 64 bits of row y, from x on.
  std::uint64_t bits_from(int x, int y) const {
    const std::uint64_t* bits = row(y) + x / 64;
    return x % 64 == 0 ? bits[0] : bits[0] >> (x % 64) | bits[1] << (64 - x % 64);
  }

  bool collides(const Bitmap& shape, int x, int y) const {
    for (int line = 0; line < shape.height_; ++line)
      for (int word = 0; word < shape.words_ && x / 64 + word < words_; ++word)
        if (row(y + line)[x / 64 + word] & shape.shifted_word(line, word, x % 64)) return true;
    return false;
  }

  void add(const Bitmap& shape, int x, int y) {
    for (int line = 0; line < shape.height_; ++line)
      for (int word = 0; word < shape.words_ && x / 64 + word < words_; ++word)
        row(y + line)[x / 64 + word] |= shape.shifted_word(line, word, x % 64);
  }

 private:
  std::uint64_t* row(int y) { return bits_.data() + std::size_t(y) * words_; }
  const std::uint64_t* row(int y) const { return bits_.data() + std::size_t(y) * words_; }
  /// Word `word` of a row moved `shift` bits up.
  std::uint64_t shifted_word(int line, int word, int shift) const {
    const std::uint64_t* bits = row(line);
    const std::uint64_t carried = shift == 0 || word == 0 ? 0 : bits[word - 1] >> (64 - shift);
    return bits[word] << shift | carried;
  }

  int width_, height_, words_;
  std::vector<std::uint64_t> bits_;
};

Vector2d size_of(const FlatChart& chart) {
  Vector2d size = Vector2d::Zero();
  for (const Vector2d& p : chart.plane) size = size.cwiseMax(p);
  return size;
}

Vector2d turned(const Vector2d& p, const Vector2d& size, int quarter_turns) {
  switch (quarter_turns) {
    case 1:
      return {size.y() - p.y(), p.x()};
    case 2:
      return size - p;
    case 3:
      return {p.y(), size.x() - p.x()};
    default:
      return p;
  }
}

struct Cell {
  int x, y;
};

/// Some cells of a shape, spread over it.
std::vector<Cell> sample_cells(const Bitmap& shape) {
  // With 16, hardly a place gets past them that does not fit.
  constexpr std::size_t kSamples = 16;
  std::vector<Cell> cells, samples;
  for (int y = 0; y < shape.height(); ++y)
    for (int x = 0; x < shape.width(); ++x)
      if (shape.at(x, y)) cells.push_back({x, y});
  const std::size_t count = std::min(kSamples, cells.size());
  for (std::size_t i = 0; i < count; ++i) samples.push_back(cells[i * cells.size() / count]);
  return samples;
}

/// The lowest, then leftmost place where `shape` collides with nothing of `atlas`. Samples rule out 64 places at a
/// time.
std::optional<Cell> find_place(const Bitmap& atlas, const Bitmap& shape) {
  const std::vector<Cell> samples = sample_cells(shape);
  for (int y = 0; y + shape.height() <= atlas.height(); ++y)
    for (int x = 0; x + shape.width() <= atlas.width(); x += 64) {
      std::uint64_t possible = ~std::uint64_t{0};
      for (std::size_t i = 0; i < samples.size() && possible; ++i)
        possible &= ~atlas.bits_from(x + samples[i].x, y + samples[i].y);
      for (; possible; possible &= possible - 1) {
        const int place = x + std::countr_zero(possible);
        if (place + shape.width() > atlas.width()) break;
        if (!atlas.collides(shape, place, y)) return Cell{place, y};
      }
    }
  return std::nullopt;
}

/// Sets every cell whose square, grown by `grow`, touches the triangle: separating axes along both sides and each edge.
void cover_triangle(const std::array<Vector2d, 3>& p, double cell, double grow, Bitmap& cells) {
  const Vector2d lower = p[0].cwiseMin(p[1]).cwiseMin(p[2]), upper = p[0].cwiseMax(p[1]).cwiseMax(p[2]);
  const auto first = [&](double value) { return std::max(0, static_cast<int>(std::floor((value - grow) / cell))); };
  const int x_end = std::min(cells.width() - 1, first(upper.x() + 2 * grow));
  const int y_end = std::min(cells.height() - 1, first(upper.y() + 2 * grow));
  const double half = cell / 2 + grow;
  for (int y = first(lower.y()); y <= y_end; ++y)
    for (int x = first(lower.x()); x <= x_end; ++x) {
      const Vector2d centre((x + 0.5) * cell, (y + 0.5) * cell);
      bool touches = true;
      for (int k = 0; k < 3 && touches; ++k) {
        const Vector2d along = p[(k + 1) % 3] - p[k], to_centre = centre - p[k];
        const double reach = half * (std::abs(along.x()) + std::abs(along.y()));
        touches = along.x() * to_centre.y() - along.y() * to_centre.x() >= -reach;
      }
      if (touches) cells.set(x, y);
    }
}

class Packer {
 public:
  Packer(std::span<const FlatChart> charts, int resolution, int cell_texels, int gutter_texels)
      : charts_(charts), cells_(resolution / cell_texels), cell_(cell_texels), gutter_(gutter_texels) {
    for (const FlatChart& chart : charts) sizes_.push_back(size_of(chart));
    order_.resize(charts.size());
    std::iota(order_.begin(), order_.end(), std::size_t{0});
    std::stable_sort(order_.begin(), order_.end(),
                     [&](std::size_t a, std::size_t b) { return sizes_[a].maxCoeff() > sizes_[b].maxCoeff(); });
  }

  std::optional<std::vector<Placement>> try_scale(double scale) const {
    Bitmap atlas(cells_, cells_);
    std::vector<Placement> placements(charts_.size());
    for (const std::size_t chart : order_) {
      std::array<Fit, 4> fits;
      parallel_for(4, [&](std::size_t turn) { fits[turn] = find_fit(atlas, chart, static_cast<int>(turn), scale); });
      // The lowest, then the leftmost, then the least turned.
      const auto best = std::min_element(fits.begin(), fits.end(), [](const Fit& a, const Fit& b) {
        return std::pair(a.y, a.x) < std::pair(b.y, b.x);
      });
      if (!best->shape) return std::nullopt;
      atlas.add(*best->shape, best->x, best->y);
      placements[chart] = {static_cast<int>(best - fits.begin()),
                           Vector2d(best->x * cell_ + gutter_, best->y * cell_ + gutter_)};
    }
    return placements;
  }

 private:
  struct Fit {
    int x = 1 << 30, y = 1 << 30;
    std::optional<Bitmap> shape;
  };

  Fit find_fit(const Bitmap& atlas, std::size_t chart, int quarter_turns, double scale) const {
    const Vector2d size = turned(sizes_[chart], Vector2d::Zero(), quarter_turns).cwiseAbs() * scale;
    const auto cells_across = [&](double texels) {
      return static_cast<int>(std::floor((texels + 2 * gutter_) / cell_)) + 1;
    };
    if (!(size.maxCoeff() < double(cells_) * cell_)) return {};
    const int width = cells_across(size.x()), height = cells_across(size.y());
    if (width > cells_ || height > cells_) return {};
    Bitmap shape(width, height);
    for (const auto& t : charts_[chart].triangles) {
      std::array<Vector2d, 3> corners;
      for (int k = 0; k < 3; ++k)
        corners[k] =
            turned(charts_[chart].plane[t[k]], sizes_[chart], quarter_turns) * scale + Vector2d(gutter_, gutter_);
      cover_triangle(corners, cell_, gutter_, shape);
    }
    const std::optional<Cell> found = find_place(atlas, shape);
    return found ? Fit{found->x, found->y, std::move(shape)} : Fit{};
  }

  std::span<const FlatChart> charts_;
  int cells_;
  double cell_, gutter_;
  std::vector<Vector2d> sizes_;
  std::vector<std::size_t> order_;
};

}  // namespace

std::optional<Packing> pack_charts(std::span<const FlatChart> charts, int resolution, int cell_texels,
                                   int gutter_texels) {
  const Packer packer(charts, resolution, cell_texels, gutter_texels);
  double area = 0;
  for (const FlatChart& chart : charts) area += chart.area;
  // 10 halvings: the scale is within a thousandth of the largest that was found.
  constexpr int kHalvings = 10;
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

Vector2d place(const FlatChart& chart, const Placement& placement, double scale, const Vector2d& point) {
  return turned(point, size_of(chart), placement.quarter_turns) * scale + placement.offset;
}

}  // namespace redmap
