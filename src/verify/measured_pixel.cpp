#include "verify/measured_pixel.h"

#include <atomic>
#include <cmath>
#include <optional>

#include "base/parallel.h"
#include "base/random.h"
#include "metrics/flip.h"

namespace redmap {

namespace {

/// Draws for one pixel, at most: at 32 texels a pixel, nine in ten rays of a bunny see a silhouette.
constexpr int kDraws = 64;
/// Samples that tell at once whether a pixel is interior; the truth's own samples have the last word.
constexpr int kGlanceSamples = 36;
/// Jitter of the glance and of the halves of the truth.
constexpr std::uint64_t kGlance = 1, kFirstHalf = 2, kSecondHalf = 3;

bool is_interior(PixelClass seen) { return seen == PixelClass::kInterior || seen == PixelClass::kSeam; }

/// Rays a side of a pixel, at most (3 on seams, 4 on silhouettes).
constexpr float kMostRaysASide = 4;

/// Whether nothing but the map was at work: no ray's footprint was so narrow that the shader itself was asked.
bool is_by_map(const RenderedPixel& rendered, const PixelCase& pixel) {
  switch (rendered.decision) {
    case Decision::kMeanNormal:
    case Decision::kConvolved:
    case Decision::kDrawn:
      return true;
    case Decision::kSubdivided:
      return pixel.minification * std::sqrt(pixel.anisotropy) >= kMostRaysASide;
    default:
      return false;
  }
}

double flip_of_patch(Rgb value, Rgb truth) {
  Image image(1, 1, 3), reference(1, 1, 3);
  image.set_rgb(0, 0, value), reference.set_rgb(0, 0, truth);
  return flip_difference(image, reference).data[0];
}

std::optional<MeasuredPixel> measure(const PixelRenderer& renderer, const PixelCase& pixel,
                                     const std::unique_ptr<ObjectShading>& shading, const StageMeter* stages,
                                     const MeasureOptions& options) {
  const int half = options.spp / 2;
  const RenderedPixel a = renderer.original(pixel, half, kFirstHalf);
  if (!is_interior(a.seen)) return std::nullopt;
  const RenderedPixel b = renderer.original(pixel, half, kSecondHalf);
  const RenderedPixel map = renderer.frame(pixel, shading, options.quality, options.supersampled);
  MeasuredPixel measured{pixel, (a.value + b.value) * 0.5f, map.value};
  measured.error = rms(measured.map - measured.truth);
  measured.residual = 0.5 * rms(a.value - b.value);
  measured.on_seam = a.seen == PixelClass::kSeam;
  measured.by_map = is_by_map(map, pixel);
  if (stages && measured.by_map)
    measured.stages = stages->measure(renderer, pixel, options.quality, map.value, a.value, half, kFirstHalf);
  return measured;
}

}  // namespace

double rms(Rgb value) {
  return std::sqrt((static_cast<double>(value.r) * value.r + static_cast<double>(value.g) * value.g +
                    static_cast<double>(value.b) * value.b) /
                   3);
}

std::vector<PixelCase> draw_interior_pixels(const PixelRenderer& renderer, const ReductionMap& map,
                                            const DrawOptions& options) {
  const std::size_t count = options.minifications.size() * options.pixels;
  std::vector<std::optional<PixelCase>> drawn(count);
  parallel_for(count, [&](std::size_t i) {
    const float minification = options.minifications[i / options.pixels];
    for (int draw = 0; draw < kDraws && !drawn[i]; ++draw) {
      drawn[i] = draw_pixel(renderer.scene(), renderer.tracer(), map, options.quality, minification,
                            hash64(options.seed, i, static_cast<std::uint64_t>(draw)));
      if (drawn[i] && !is_interior(renderer.original(*drawn[i], kGlanceSamples, kGlance).seen)) drawn[i].reset();
    }
  });
  std::vector<PixelCase> pixels;
  for (const std::optional<PixelCase>& pixel : drawn)
    if (pixel) pixels.push_back(*pixel);
  return pixels;
}

std::vector<MeasuredPixel> measure_pixels(const PixelRenderer& renderer, std::span<const PixelCase> pixels,
                                          const std::unique_ptr<ObjectShading>& shading, const StageMeter* stages,
                                          const MeasureOptions& options) {
  std::vector<std::optional<MeasuredPixel>> measured(pixels.size());
  std::atomic<std::size_t> done = 0;
  parallel_for(pixels.size(), [&](std::size_t i) {
    if (options.cancelled && options.cancelled()) return;
    measured[i] = measure(renderer, pixels[i], shading, stages, options);
    if (options.progress) options.progress(static_cast<double>(++done) / static_cast<double>(pixels.size()));
  });
  std::vector<MeasuredPixel> interior;
  for (const std::optional<MeasuredPixel>& pixel : measured) {
    if (!pixel) continue;
    interior.push_back(*pixel);
    interior.back().flip = flip_of_patch(pixel->map, pixel->truth);
  }
  return interior;
}

SurfacePoints places_of(const PixelRenderer& renderer, std::span<const PixelCase> pixels) {
  std::vector<HitCoordinates> where;
  for (const PixelCase& pixel : pixels) where.push_back(pixel.where);
  ShadingBatch batch;
  batch.hits.resize(where.size());
  renderer.scene().objects.front().surface->complete(where, batch.hits);
  return surface_points(batch);
}

}  // namespace redmap
