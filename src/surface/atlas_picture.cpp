#include "surface/atlas_picture.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "surface/charts.h"
#include "surface/uv_edge.h"

namespace redmap {

namespace {

constexpr int kNoChart = -1;
constexpr int kSamples = 3;  // across and down a pixel: enough for edges to look smooth

/// Hues a golden section apart, so that neighbours in number are far apart in colour; light enough for dark outlines.
Rgb color_of(int chart) {
  constexpr float kGoldenSection = 0.61803399f;
  const float hue = 2 * kPi * std::fmod(kGoldenSection * static_cast<float>(chart), 1.0f);
  const auto wave = [&](float shift) { return 0.55f + 0.35f * std::cos(hue - shift * 2 * kPi / 3); };
  return {wave(0), wave(1), wave(2)};
}

/// The chart at every sample, `side` x `side` of them, v upwards.
std::vector<int> chart_samples(const TriangleMesh& mesh, int side) {
  std::vector<int> samples(std::size_t(side) * side, kNoChart);
  const std::vector<std::uint32_t> charts = find_charts(mesh);
  for (std::size_t t = 0; t < mesh.uv_triangles.size(); ++t) {
    TexelPoint p[3];
    for (int k = 0; k < 3; ++k) {
      const Vec2 uv = mesh.uv[mesh.uv_triangles[t][k]];
      p[k] = {double(uv.x) * side, double(uv.y) * side};
    }
    if (UvEdge(p[0], p[1]).side(p[2]) < 0) std::swap(p[1], p[2]);
    const UvEdge edges[3] = {{p[0], p[1]}, {p[1], p[2]}, {p[2], p[0]}};
    const auto [left, right] = std::minmax({p[0].x, p[1].x, p[2].x});
    const auto [bottom, top] = std::minmax({p[0].y, p[1].y, p[2].y});
    const auto first = [&](double low) {
      return static_cast<int>(std::clamp(std::ceil(low - 0.5), 0.0, double(side)));
    };
    const auto last = [&](double high) {
      return static_cast<int>(std::clamp(std::floor(high - 0.5), -1.0, double(side - 1)));
    };
    for (int y = first(bottom); y <= last(top); ++y)
      for (int x = first(left); x <= last(right); ++x) {
        const TexelPoint at{x + 0.5, y + 0.5};
        if (edges[0].side(at) >= 0 && edges[1].side(at) >= 0 && edges[2].side(at) >= 0)
          samples[std::size_t(y) * side + x] = static_cast<int>(charts[t]);
      }
  }
  return samples;
}

}  // namespace

Image draw_atlas(const TriangleMesh& mesh, int size) {
  if (mesh.uv_triangles.empty()) throw Error("atlas picture: expected a mesh with uv, found one without");
  const int side = size * kSamples;
  const std::vector<int> samples = chart_samples(mesh, side);
  const auto chart_at = [&](int x, int y) {
    return samples[std::size_t(std::clamp(y, 0, side - 1)) * side + std::clamp(x, 0, side - 1)];
  };
  const auto color_at = [&](int x, int y) {
    const int chart = chart_at(x, y);
    // An outline as wide as a pixel, inside the chart.
    for (const auto& [dx, dy] : {std::pair{kSamples, 0}, {-kSamples, 0}, {0, kSamples}, {0, -kSamples}})
      if (chart != kNoChart && chart_at(x + dx, y + dy) != chart) return Rgb{0.02f, 0.02f, 0.02f};
    return chart == kNoChart ? Rgb{1, 1, 1} : color_of(chart);
  };
  Image image(size, size, 3);
  for (int y = 0; y < size; ++y)
    for (int x = 0; x < size; ++x) {
      Rgb sum;
      for (int i = 0; i < kSamples * kSamples; ++i)
        sum += color_at(x * kSamples + i % kSamples, (size - 1 - y) * kSamples + i / kSamples);
      image.set_rgb(x, y, sum * (1.0f / (kSamples * kSamples)));
    }
  return image;
}

}  // namespace redmap
