#include <algorithm>
#include <cmath>

#include "render/tile.h"

namespace redmap {

namespace {

// Samples shaded together: enough to fill the lanes, small enough for the cache.
constexpr std::size_t kWavefrontSamples = 4096;

/// Tells the pixel whose samples are [first, first + count) apart.
PixelClass classify(const FrameContext& frame, const TracedSamples& traced, std::span<const SampleView> views,
                    std::size_t first, std::size_t count) {
  bool charts_agree = true;
  const RayHit& hit = traced.hits[first];
  const SampleView& view = views[first];
  // Depth is continuous as long as samples stay within a pixel's width of the first one's tangent plane.
  const float tolerance = hit.t * frame.camera.pixel_angle;
  for (std::size_t i = first; i < first + count; ++i) {
    if (traced.hits[i].object != hit.object) return PixelClass::kSilhouette;
    if (hit.object == kNoObject) continue;
    if (views[i].lit != view.lit) return PixelClass::kSilhouette;
    if (std::abs(dot(views[i].position - view.position, normalized(view.geometric_normal))) > tolerance)
      return PixelClass::kSilhouette;
    charts_agree &= views[i].chart == view.chart;
  }
  if (hit.object == kNoObject) return PixelClass::kBackground;
  return charts_agree ? PixelClass::kInterior : PixelClass::kSeam;
}

}  // namespace

RenderCounts render_supersampled(const TileJob& job, Tile tile) {
  RenderCounts counts;
  const int spp = job.options->spp;
  const Strata strata = strata_of(spp);
  const std::size_t pixels_together = std::max<std::size_t>(1, kWavefrontSamples / spp);
  TracedSamples traced;
  std::vector<SampleView> views;
  std::vector<std::uint32_t> pixels;
  const auto flush = [&] {
    trace_samples(*job.frame, traced, counts);
    shade_samples(*job.frame, traced, job.pixels, counts, job.classes ? &views : nullptr);
    if (job.classes)
      for (std::size_t k = 0; k < pixels.size(); ++k)
        job.classes[pixels[k]] = classify(*job.frame, traced, views, k * spp, spp);
    traced.clear(), pixels.clear();
  };
  for (int y = tile.y0; y < tile.y1; ++y)
    for (int x = tile.x0; x < tile.x1; ++x) {
      const std::uint32_t pixel = static_cast<std::uint32_t>(y) * job.image_width + x;
      // One sample a pixel is the aliased picture everybody knows: through the centre.
      const std::uint64_t seed = spp == 1 ? 0 : jitter_seed(job, pixel);
      append_pixel_samples(pixel, job.image_width, strata.columns, strata.rows, seed, traced.samples);
      pixels.push_back(pixel);
      if (pixels.size() == pixels_together) flush();
    }
  if (!pixels.empty()) flush();
  return counts;
}

}  // namespace redmap
