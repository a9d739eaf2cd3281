#include "verify/error_picture.h"

#include <algorithm>
#include <cmath>

#include "map/pyramid.h"

namespace redmap {

namespace {

constexpr Rgb kNoSurface{0.2f, 0.2f, 0.2f}, kRing{0.1f, 0.6f, 1};
/// Cells across the picture that errors are collected in: about as many as pixels are measured by default.
constexpr int kCells = 32;

/// Black, red, yellow, white, as heat is painted.
Rgb heat(float value) {
  const auto ramp = [&](float begin) { return std::clamp(3 * value - begin, 0.0f, 1.0f); };
  return {ramp(0), ramp(1), ramp(2)};
}

/// Largest error in every cell; a cell without gets the mean of those near.
Pyramid<float> collect(std::span<const MeasuredPixel> pixels, Extent cells) {
  BaseLevel base(cells, 1, false);
  for (const MeasuredPixel& pixel : pixels) {
    const auto cell = [](float coordinate, int count) {
      return std::clamp(static_cast<int>(coordinate * static_cast<float>(count)), 0, count - 1);
    };
    const std::size_t i = static_cast<std::size_t>(cell(pixel.pixel.uv.y, cells.height)) * cells.width +
                          cell(pixel.pixel.uv.x, cells.width);
    base.values[i] = std::max(base.values[i], static_cast<float>(pixel.error));
    base.coverage[i] = 1;
  }
  return Pyramid<float>(base);
}

void draw_ring(Image& picture, Vec2 uv) {
  const float radius = 0.02f * static_cast<float>(picture.width), thickness = std::max(1.0f, 0.2f * radius);
  const float x0 = uv.x * static_cast<float>(picture.width), y0 = (1 - uv.y) * static_cast<float>(picture.height);
  for (int y = 0; y < picture.height; ++y)
    for (int x = 0; x < picture.width; ++x) {
      const float distance = std::hypot(static_cast<float>(x) + 0.5f - x0, static_cast<float>(y) + 0.5f - y0);
      if (std::abs(distance - radius) < thickness) picture.set_rgb(x, y, kRing);
    }
}

}  // namespace

Image paint_errors(const ReductionMap& map, std::span<const MeasuredPixel> pixels, double white, int width) {
  int level = 0;
  while (map.weights.extent(level).width > width) ++level;
  const Extent extent = map.weights.extent(level);
  const Extent cells{std::min(kCells, extent.width),
                     std::max(1, std::min(kCells, extent.width) * extent.height / extent.width)};
  const Pyramid<float> errors = collect(pixels, cells);
  Image picture(extent.width, extent.height, 3);
  for (int y = 0; y < extent.height; ++y)
    for (int x = 0; x < extent.width; ++x) {
      const bool is_surface = map.weights.coverage(level, x, y) > 0;
      const float error = errors.value(0, x * cells.width / extent.width, y * cells.height / extent.height, 0);
      picture.set_rgb(x, extent.height - 1 - y, is_surface ? heat(error / static_cast<float>(white)) : kNoSurface);
    }
  const auto worst = std::max_element(pixels.begin(), pixels.end(),
                                      [](const MeasuredPixel& a, const MeasuredPixel& b) { return a.error < b.error; });
  if (worst != pixels.end()) draw_ring(picture, worst->pixel.uv);
  return picture;
}

}  // namespace redmap
