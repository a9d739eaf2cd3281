// Pixels of one object, rendered by brute force and through its map: what verdicts are made of.
#pragma once

#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "verify/stages.h"

namespace redmap {

struct MeasuredPixel {
  PixelCase pixel;
  Rgb truth, map;       ///< linear light
  double error = 0;     ///< root mean square over R, G and B, unclamped
  double residual = 0;  ///< of the truth itself: half the difference of its two halves, likewise
  double flip = 0;      ///< LDR-FLIP of a patch of that colour: what the eye makes of the error, [0, 1]
  bool on_seam = false;
  bool by_map = false;   ///< whether the map alone made the pixel: not blended with the shader, nor supersampled
  StageErrors stages{};  ///< where `by_map`; else zero
};

struct DrawOptions {
  Quality quality = Quality::kDefault;
  std::vector<float> minifications;
  int pixels = 0;  ///< for each minification
  std::uint64_t seed = 0;
};

/// Random interior pixels (one object, continuous depth, the same light in all of it), those of one minification after
/// the other, in random order. Fewer than asked for where hardly any pixel is interior.
std::vector<PixelCase> draw_interior_pixels(const PixelRenderer& renderer, const ReductionMap& map,
                                            const DrawOptions& options);

struct MeasureOptions {
  Quality quality = Quality::kDefault;
  int spp = 1024;                             ///< of the truth: two halves
  bool supersampled = false;                  ///< the map does not reduce: frames sample the shader
  std::function<void(double part)> progress;  ///< from any thread; may be empty
  std::function<bool()> cancelled;            ///< polled between pixels; may be empty
};

/// Every pixel as `shading` renders it in a frame, and the truth; `stages` may be null. Pixels that turn out not to be
/// interior are left out. The same for any number of threads.
std::vector<MeasuredPixel> measure_pixels(const PixelRenderer& renderer, std::span<const PixelCase> pixels,
                                          const std::unique_ptr<ObjectShading>& shading, const StageMeter* stages,
                                          const MeasureOptions& options);

/// The places in the middle of the pixels, as shaders see them.
SurfacePoints places_of(const PixelRenderer& renderer, std::span<const PixelCase> pixels);

/// Root mean square over R, G and B.
double rms(Rgb value);

}  // namespace redmap
