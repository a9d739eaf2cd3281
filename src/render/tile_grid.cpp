#include <algorithm>
#include <cmath>

#include "render/tile.h"

namespace redmap {

namespace {

/// Why a pixel gets more rays, from the cheapest to the dearest.
enum class Refine : std::uint8_t { kNo, kSeam, kSilhouette, kSupersample };

/// The samples of a tile on a regular grid, n x n a pixel, with one more row and column of samples all around.
struct SampleGrid {
  int n, width, height;
  TracedSamples traced;
  std::vector<SampleView> views;

  std::size_t index(int i, int j) const { return static_cast<std::size_t>(j + 1) * width + (i + 1); }
};

SampleGrid trace_grid(const TileJob& job, Tile tile, int n, RenderCounts& counts) {
  SampleGrid grid{n, (tile.x1 - tile.x0) * n + 2, (tile.y1 - tile.y0) * n + 2, {}, {}};
  const float step = 1.0f / static_cast<float>(n);
  for (int j = -1; j < grid.height - 1; ++j)
    for (int i = -1; i < grid.width - 1; ++i) {
      const float x = static_cast<float>(tile.x0) + (static_cast<float>(i) + 0.5f) * step;
      const float y = static_cast<float>(tile.y0) + (static_cast<float>(j) + 0.5f) * step;
      grid.traced.samples.push_back({0, x, y, step, step * step});
    }
  trace_samples(*job.frame, grid.traced, counts);

  // Charts, places and normals, for telling neighbours apart.
  grid.views.resize(grid.traced.samples.size());
  for (std::size_t k = 0; k < grid.views.size(); ++k) {
    const RayHit& hit = grid.traced.hits[k];
    if (hit.object == kNoObject) continue;
    const Ray& ray = grid.traced.rays[k];
    grid.views[k] = {job.frame->scene->objects[hit.object].surface->chart(hit.where.primitive), 0,
                     ray.origin + ray.direction * hit.t,
                     job.frame->tracer->placement(hit.object).direction_world(normalized(hit.geometric_normal))};
  }
  return grid;
}

/// How two neighbouring samples differ.
Refine difference(const FrameContext& frame, const SampleGrid& grid, std::size_t a, std::size_t b) {
  const RayHit &hit_a = grid.traced.hits[a], &hit_b = grid.traced.hits[b];
  if (hit_a.object != hit_b.object) return Refine::kSilhouette;
  if (hit_a.object == kNoObject) return Refine::kNo;
  // Occlusion: the neighbour lies off this sample's tangent plane by more than the distance between samples.
  const float step = hit_a.t * frame.camera.pixel_angle / static_cast<float>(grid.n);
  const Vec3 across = grid.views[b].position - grid.views[a].position;
  if (std::abs(dot(across, grid.views[a].geometric_normal)) > step) return Refine::kSilhouette;
  return grid.views[a].chart != grid.views[b].chart ? Refine::kSeam : Refine::kNo;
}

/// The dearest reason among the samples of a pixel and their neighbours.
Refine refinement(const TileJob& job, const SampleGrid& grid, int pixel_i, int pixel_j) {
  Refine reason = Refine::kNo;
  for (int j = pixel_j; j < pixel_j + grid.n; ++j)
    for (int i = pixel_i; i < pixel_i + grid.n; ++i) {
      const std::size_t here = grid.index(i, j);
      for (const std::size_t there :
           {grid.index(i + 1, j), grid.index(i, j + 1), grid.index(i - 1, j), grid.index(i, j - 1)})
        reason = std::max(reason, difference(*job.frame, grid, here, there));
      const std::uint32_t object = grid.traced.hits[here].object;
      if (object != kNoObject && (*job.supersampled)[object]) return Refine::kSupersample;
    }
  return reason;
}

/// Rays a side of a refined pixel.
int refined_rays(Refine reason, Quality quality) {
  switch (reason) {
    case Refine::kSeam:
      return quality == Quality::kFast ? 2 : 3;
    case Refine::kSilhouette:
      return quality == Quality::kFast ? 3 : 4;
    case Refine::kSupersample:
      return 4;  // 16 samples, what the paper falls back to
    case Refine::kNo:
      break;
  }
  return 0;
}

void keep_sample(const SampleGrid& grid, std::size_t k, std::uint32_t pixel, TracedSamples& kept) {
  CameraSample sample = grid.traced.samples[k];
  sample.pixel = pixel;
  kept.samples.push_back(sample);
  kept.rays.push_back(grid.traced.rays[k]);
  kept.hits.push_back(grid.traced.hits[k]);
}

}  // namespace

RenderCounts render_grid(const TileJob& job, Tile tile) {
  RenderCounts counts;
  const RenderOptions& options = *job.options;
  const int given = options.method == Method::kOriginal ? strata_of(std::max(options.spp, 1)).rows : 0;
  const bool fixed = options.method == Method::kOriginal && options.spp > 0;
  const int n = fixed ? given : options.quality == Quality::kFast ? 1 : 2;
  const SampleGrid grid = trace_grid(job, tile, n, counts);

  TracedSamples kept, refined;
  for (int y = tile.y0; y < tile.y1; ++y)
    for (int x = tile.x0; x < tile.x1; ++x) {
      const std::uint32_t pixel = static_cast<std::uint32_t>(y) * job.image_width + x;
      const int i0 = (x - tile.x0) * n, j0 = (y - tile.y0) * n;
      const Refine reason = fixed ? Refine::kNo : refinement(job, grid, i0, j0);
      const int rays = refined_rays(reason, options.quality);
      counts.supersampled_pixels += reason == Refine::kSupersample;
      if (rays > n)
        append_pixel_samples(pixel, job.image_width, rays, rays, 0, refined.samples);
      else
        for (int j = j0; j < j0 + n; ++j)
          for (int i = i0; i < i0 + n; ++i) keep_sample(grid, grid.index(i, j), pixel, kept);
    }
  shade_samples(*job.frame, kept, job.rgb, counts);
  trace_samples(*job.frame, refined, counts);
  shade_samples(*job.frame, refined, job.rgb, counts);
  return counts;
}

}  // namespace redmap
