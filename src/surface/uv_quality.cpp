#include "surface/uv_quality.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "surface/uv_edge.h"

namespace redmap {

namespace {

// Tiles 1001 to 1999: ten columns, the numbers' four digits leave a hundred rows.
constexpr int kColumns = 10, kRows = 100;

// Atlases written with few digits may end a hair outside their tile.
constexpr double kSlack = 1e-5;

// Limits of what is used, in parts of the covered texels, the surface and the square. A texel that two places share
// shows the wrong one on one of them: more than one in a thousand is seen, slivers along the seams of hand-made uv stay
// below. At a tenth of the square our own atlas (60 % and more) has over twice the texels to the unit of length.
constexpr double kMostOverlap = 1e-3, kMostDegenerate = 1e-3, kLeastCoverage = 0.1;

// Area in uv over area on the surface, of the mean: below it a triangle has next to no texels of its own.
constexpr double kDegenerateDensity = 1e-4;

Vec2 uv_at(const TriangleMesh& mesh, std::size_t t, int k) { return mesh.uv[mesh.uv_triangles[t][k]]; }

double uv_area(const TriangleMesh& mesh, std::size_t t) {
  const Vec2 a = uv_at(mesh, t, 0), b = uv_at(mesh, t, 1), c = uv_at(mesh, t, 2);
  return 0.5 * ((double(b.x) - a.x) * (double(c.y) - a.y) - (double(b.y) - a.y) * (double(c.x) - a.x));
}

double surface_area(const TriangleMesh& mesh, std::size_t t) {
  const auto& [a, b, c] = mesh.triangles[t];
  return 0.5 * length(cross(mesh.positions[b] - mesh.positions[a], mesh.positions[c] - mesh.positions[a]));
}

/// What covers the texel centres of one tile.
class CoverageRaster {
 public:
  explicit CoverageRaster(int resolution)
      : resolution_(resolution), texels_(std::size_t(resolution) * resolution, kEmpty) {}

  /// Marks the centres strictly inside: those on an edge that two triangles share belong to neither.
  void add(const TriangleMesh& mesh, std::size_t t, Vec2 corner) {
    TexelPoint p[3];
    for (int k = 0; k < 3; ++k) {
      const Vec2 uv = uv_at(mesh, t, k);
      p[k] = {(double(uv.x) - corner.x) * resolution_, (double(uv.y) - corner.y) * resolution_};
    }
    const bool turned = uv_area(mesh, t) < 0;
    if (turned) std::swap(p[1], p[2]);
    const UvEdge edges[3] = {{p[0], p[1]}, {p[1], p[2]}, {p[2], p[0]}};
    const auto [left, right] = std::minmax({p[0].x, p[1].x, p[2].x});
    const auto [bottom, top] = std::minmax({p[0].y, p[1].y, p[2].y});
    for (int y = first(bottom); y <= last(top); ++y)
      for (int x = first(left); x <= last(right); ++x) {
        const TexelPoint at{x + 0.5, y + 0.5};
        if (edges[0].side(at) > 0 && edges[1].side(at) > 0 && edges[2].side(at) > 0)
          mark(texels_[std::size_t(y) * resolution_ + x], turned);
      }
  }

  void count(UvReport& report) const {
    for (const std::uint8_t texel : texels_) {
      report.covered_texels += texel != kEmpty;
      report.overlapping_texels += (texel & kTwice) != 0;
      report.mirrored_texels += (texel & kTwice) && (texel & kForward) && (texel & kTurned);
    }
  }

 private:
  static constexpr std::uint8_t kEmpty = 0, kForward = 1, kTurned = 2, kTwice = 4;

  static void mark(std::uint8_t& texel, bool turned) {
    if (texel != kEmpty) texel |= kTwice;
    texel |= turned ? kTurned : kForward;
  }
  int first(double low) const { return std::max(0, static_cast<int>(std::ceil(low - 0.5))); }
  int last(double high) const { return std::min(resolution_ - 1, static_cast<int>(std::floor(high - 0.5))); }

  int resolution_;
  std::vector<std::uint8_t> texels_;
};

Vec2 corner_of(int tile) {
  return {static_cast<float>((tile - kFirstTile) % kColumns), static_cast<float>((tile - kFirstTile) / kColumns)};
}

/// Degenerate area and the spread of texel density over the surface.
void measure_density(const TriangleMesh& mesh, UvReport& report) {
  std::vector<std::pair<double, double>> densities;  // area in uv over area on the surface; area on the surface
  double area = 0, area_in_uv = 0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const double on_surface = surface_area(mesh, t), in_uv = std::abs(uv_area(mesh, t));
    if (!(on_surface > 0)) continue;
    densities.emplace_back(in_uv / on_surface, on_surface);
    area += on_surface, area_in_uv += in_uv;
  }
  if (!(area_in_uv > 0)) {
    report.degenerate_area = 1;
    return;
  }
  std::sort(densities.begin(), densities.end());
  const double mean = area_in_uv / area;
  double below = 0;
  for (const auto& [density, on_surface] : densities) {
    if (density < kDegenerateDensity * mean) report.degenerate_area += on_surface / area;
    const double root = std::sqrt(density / mean);
    if (below <= 0.05 * area) report.density_low = root;
    if (below <= 0.95 * area) report.density_high = root;
    below += on_surface;
  }
}

std::string problem_of(const UvReport& report, const TriangleMesh& mesh) {
  if (report.degenerate_area > kMostDegenerate)
    return fmt::format("{:.3g} % of the surface have no area in uv", 100 * report.degenerate_area);
  if (report.triangles_outside > 0)
    return fmt::format("{} of {} triangles lie outside the tiles of uv or across their borders",
                       report.triangles_outside, mesh.triangles.size());
  const auto covered = static_cast<double>(std::max<std::size_t>(1, report.covered_texels));
  if (static_cast<double>(report.overlapping_texels) > kMostOverlap * covered)
    return fmt::format("uv overlap on {:.3g} % of the covered texels{}",
                       100 * static_cast<double>(report.overlapping_texels) / covered,
                       2 * report.mirrored_texels > report.overlapping_texels ? ", mirrored" : "");
  if (report.coverage < kLeastCoverage)
    return fmt::format("uv cover only {:.3g} % of their tiles", 100 * report.coverage);
  return "";
}

}  // namespace

std::vector<int> tiles_of(const TriangleMesh& mesh) {
  std::vector<int> tiles(mesh.uv_triangles.size());
  for (std::size_t t = 0; t < tiles.size(); ++t) {
    const Vec2 a = uv_at(mesh, t, 0), b = uv_at(mesh, t, 1), c = uv_at(mesh, t, 2);
    const auto [left, right] = std::minmax({double(a.x), double(b.x), double(c.x)});
    const auto [bottom, top] = std::minmax({double(a.y), double(b.y), double(c.y)});
    // The tile that the middle is in; its corners may touch the border.
    const double column = std::floor((left + right) / 2), row = std::floor((bottom + top) / 2);
    const bool is_inside = column >= 0 && column < kColumns && row >= 0 && row < kRows && left >= column - kSlack &&
                           right <= column + 1 + kSlack && bottom >= row - kSlack && top <= row + 1 + kSlack;
    if (is_inside) tiles[t] = kFirstTile + static_cast<int>(column) + kColumns * static_cast<int>(row);
  }
  return tiles;
}

TriangleMesh extract_tile(const TriangleMesh& mesh, int tile) {
  TriangleMesh result = mesh;
  const std::vector<int> tiles = tiles_of(mesh);
  std::vector<std::uint8_t> keep(tiles.size());
  for (std::size_t t = 0; t < tiles.size(); ++t) keep[t] = tiles[t] == tile;
  keep_triangles(result, keep);
  // Only this tile's uv, moved; what belongs to other tiles would lie outside the square.
  std::vector<Vec2> moved;
  const Vec2 corner = corner_of(tile);
  for (Triangle& t : result.uv_triangles)
    for (std::uint32_t& index : t) {
      const Vec2 uv = result.uv[index];
      index = static_cast<std::uint32_t>(moved.size());
      moved.push_back({std::clamp(uv.x - corner.x, 0.0f, 1.0f), std::clamp(uv.y - corner.y, 0.0f, 1.0f)});
    }
  result.uv = std::move(moved);
  return result;
}

UvReport judge_uv(const TriangleMesh& mesh, int resolution) {
  UvReport report;
  const std::vector<int> tiles = tiles_of(mesh);
  report.triangles_outside = static_cast<std::size_t>(std::count(tiles.begin(), tiles.end(), 0));
  measure_density(mesh, report);
  if (report.triangles_outside == 0) {
    report.tiles = tiles;
    std::sort(report.tiles.begin(), report.tiles.end());
    report.tiles.erase(std::unique(report.tiles.begin(), report.tiles.end()), report.tiles.end());
  }
  for (const int tile : report.tiles) {
    CoverageRaster raster(resolution);
    for (std::size_t t = 0; t < tiles.size(); ++t)
      if (tiles[t] == tile) raster.add(mesh, t, corner_of(tile));
    raster.count(report);
  }
  const double texels = std::max(1.0, double(report.tiles.size())) * resolution * resolution;
  report.coverage = static_cast<double>(report.covered_texels) / texels;
  report.problem = problem_of(report, mesh);
  return report;
}

}  // namespace redmap
