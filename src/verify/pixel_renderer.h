// One pixel at a time, by the very code that renders frames: its rays, its shading, its shadows.
#pragma once

#include <memory>

#include "render/renderer.h"
#include "render/wavefront.h"
#include "verify/pixel_case.h"

namespace redmap {

/// What a pixel came to.
struct RenderedPixel {
  Rgb value;
  PixelClass seen = PixelClass::kBackground;  ///< supersample() only
  Decision decision = Decision::kBackground;  ///< frame() only: the dearest of its samples
};

/// Renders pixels of one object. Immutable: from any number of threads.
class PixelRenderer {
 public:
  explicit PixelRenderer(const Object& object);

  const Scene& scene() const { return scene_; }
  const Tracer& tracer() const { return tracer_; }

  /// `spp` stratified, jittered samples, shaded by `shading`. `seed` decides the jitter: the same, the same rays.
  RenderedPixel supersample(const PixelCase& pixel, const std::unique_ptr<ObjectShading>& shading, int spp,
                            std::uint64_t seed) const;
  /// As a frame of method map shows it. `supersampled`: its map does not reduce.
  RenderedPixel frame(const PixelCase& pixel, const std::unique_ptr<ObjectShading>& shading, Quality quality,
                      bool supersampled) const;
  RenderedPixel original(const PixelCase& pixel, int spp, std::uint64_t seed) const {
    return supersample(pixel, original_, spp, seed);
  }

 private:
  FrameContext context(const Scene& scene, const std::unique_ptr<ObjectShading>& shading) const;

  Scene scene_;
  Tracer tracer_;
  std::unique_ptr<ObjectShading> original_;
};

}  // namespace redmap
