// The paper's footprints (section 5.3): four corner rays, their enclosing square, subdivision where they disagree; and
// its supersampling of highlights (5.2).
#include <algorithm>
#include <cmath>

#include "render/tile.h"

namespace redmap {

namespace {

// A pixel whose corners disagree is subdivided once, into 4 x 4: "we shoot more rays that further subdivide the pixel".
constexpr int kSubdivision = 4;

/// uv and chart at the corners of the pixels of a tile.
struct CornerGrid {
  int width;
  std::vector<RayHit> hits;
  std::vector<SampleView> views;
  std::vector<Vec2> uv;

  std::size_t index(int i, int j) const { return static_cast<std::size_t>(j) * width + i; }
};

CornerGrid trace_corners(const TileJob& job, Tile tile, RenderCounts& counts) {
  CornerGrid grid{tile.x1 - tile.x0 + 1, {}, {}, {}};
  TracedSamples traced;
  for (int y = tile.y0; y <= tile.y1; ++y)
    for (int x = tile.x0; x <= tile.x1; ++x)
      traced.samples.push_back({0, static_cast<float>(x), static_cast<float>(y), 1, 1});
  trace_samples(*job.frame, traced, counts);
  grid.hits = traced.hits;
  grid.views.resize(grid.hits.size()), grid.uv.resize(grid.hits.size());
  for (std::size_t k = 0; k < grid.hits.size(); ++k) {
    if (grid.hits[k].object == kNoObject) continue;
    SurfaceHit hit;
    job.frame->scene->objects[grid.hits[k].object].surface->complete({&grid.hits[k].where, 1}, {&hit, 1});
    grid.views[k].chart = hit.chart;
    grid.uv[k] = hit.uv;
  }
  return grid;
}

/// Whether all four corners see the object and chart of the first.
bool corners_agree(const CornerGrid& grid, const std::size_t (&corner)[4]) {
  for (std::size_t k : corner)
    if (grid.hits[k].object != grid.hits[corner[0]].object || grid.views[k].chart != grid.views[corner[0]].chart)
      return false;
  return true;
}

/// The axis-aligned square of texels around the four corners.
Footprint enclosing_square(const CornerGrid& grid, const std::size_t (&corner)[4], const Surface& surface) {
  const Extent extent = surface.map_extent(1024);  // only its proportions matter
  const float aspect = static_cast<float>(extent.width) / static_cast<float>(extent.height);
  Vec2 lo = grid.uv[corner[0]], hi = lo;
  for (std::size_t k : corner) {
    Vec2 uv = grid.uv[k];
    if (surface.wraps_u()) uv.x -= std::round(uv.x - grid.uv[corner[0]].x);  // the corner's image nearest to the first
    lo = {std::min(lo.x, uv.x), std::min(lo.y, uv.y)};
    hi = {std::max(hi.x, uv.x), std::max(hi.y, uv.y)};
  }
  const float side = std::max({(hi.x - lo.x) * aspect, hi.y - lo.y, 1e-9f});
  return {(lo + hi) * 0.5f, {side / aspect, 0}, {0, side}};
}

/// Section 5.2: where a highlight may hide in the normals under a pixel, "we used 16" samples of the shader itself.
void supersample(const TileJob& job, std::span<const std::uint32_t> pixels, RenderCounts& counts) {
  constexpr int kStrata = 4;
  TracedSamples traced;
  for (std::uint32_t pixel : pixels)
    append_pixel_samples(pixel, job.image_width, kStrata, kStrata, jitter_seed(job, pixel), traced.samples);
  FrameContext frame = *job.frame;
  frame.shading = frame.originals;
  trace_samples(frame, traced, counts);
  shade_samples(frame, traced, job.pixels, counts);
  counts.supersampled_pixels += pixels.size();
}

}  // namespace

RenderCounts render_paper(const TileJob& job, Tile tile) {
  RenderCounts counts;
  const CornerGrid grid = trace_corners(job, tile, counts);
  TracedSamples whole, subdivided;
  std::vector<std::size_t> first_corner;  // of every sample of `whole`
  const auto subdivide = [&](std::uint32_t pixel, Decision reason) {
    if (job.pixels.decisions) job.pixels.decisions[pixel] = reason;
    append_pixel_samples(pixel, job.image_width, kSubdivision, kSubdivision, 0, subdivided.samples);
  };
  for (int y = tile.y0; y < tile.y1; ++y)
    for (int x = tile.x0; x < tile.x1; ++x) {
      const int i = x - tile.x0, j = y - tile.y0;
      const std::size_t corner[4] = {grid.index(i, j), grid.index(i + 1, j), grid.index(i, j + 1),
                                     grid.index(i + 1, j + 1)};
      const std::uint32_t pixel = static_cast<std::uint32_t>(y) * job.image_width + x;
      const std::uint32_t object = grid.hits[corner[0]].object;
      const bool reduces = object == kNoObject || !(*job.supersampled)[object];
      counts.supersampled_pixels += !reduces;
      if (!reduces || !corners_agree(grid, corner)) {
        subdivide(pixel, reduces ? Decision::kSubdivided : Decision::kSupersampled);
        continue;
      }
      append_pixel_samples(pixel, job.image_width, 1, 1, 0, whole.samples);
      whole.footprints.push_back(object == kNoObject
                                     ? Footprint{}
                                     : enclosing_square(grid, corner, *job.frame->scene->objects[object].surface));
      first_corner.push_back(corner[0]);
    }
  trace_samples(*job.frame, whole, counts);
  // Where the centre sees something that the corners missed, they say nothing about it.
  std::vector<std::uint32_t> agreed;
  for (std::uint32_t k = 0; k < whole.hits.size(); ++k) {
    const RayHit& hit = whole.hits[k];
    const std::uint32_t object = grid.hits[first_corner[k]].object;
    const bool agrees = hit.object == object &&
                        (object == kNoObject || job.frame->scene->objects[object].surface->chart(hit.where.primitive) ==
                                                    grid.views[first_corner[k]].chart);
    if (agrees)
      agreed.push_back(k);
    else
      subdivide(whole.samples[k].pixel, Decision::kSubdivided);
  }
  std::vector<std::uint32_t> deferred;
  PixelSums pixels = job.pixels;
  pixels.deferred = &deferred;
  shade_samples(*job.frame, whole, agreed, pixels, counts);
  trace_samples(*job.frame, subdivided, counts);
  shade_samples(*job.frame, subdivided, job.pixels, counts);
  supersample(job, deferred, counts);
  return counts;
}

}  // namespace redmap
