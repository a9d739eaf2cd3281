// From traced samples to pixels: hits sorted by object, shaded in batches, seen through where they transmit.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "render/shading.h"
#include "render/tracer.h"
#include "scene/camera_rays.h"

namespace redmap {

/// Everything that stays the same over a frame.
struct FrameContext {
  const Scene* scene;
  CameraRays camera;
  const Tracer* tracer;
  std::span<const std::unique_ptr<ObjectShading>> shading;    ///< one an object
  std::span<const std::unique_ptr<ObjectShading>> originals;  ///< the shaders themselves, for pixels handed back
  bool transmits = false;                                     ///< whether any object lets light through
  bool quarters = false;    ///< whether samples of whole pixels are looked up as the mean of four quarters
  float joined_pixels = 0;  ///< side of the squares of samples that are shaded as one where they may be; 0: none
};

/// Camera samples, their rays and first hits; one entry a sample. `footprints` is empty, or overrides the footprints
/// that ray differentials give to first hits.
struct TracedSamples {
  std::vector<CameraSample> samples;
  std::vector<Ray> rays;
  std::vector<RayHit> hits;
  std::vector<Footprint> footprints;

  void clear() { samples.clear(), rays.clear(), hits.clear(), footprints.clear(); }
};

/// Where light goes, and what else is recorded of pixels (row-major).
struct PixelSums {
  float* rgb;                     ///< three floats a pixel
  Decision* decisions = nullptr;  ///< raised to the dearest decision of a first hit; null: not recorded
  std::vector<std::uint32_t>* deferred = nullptr;  ///< pixels whose sample is to be replaced; null: none may be
  std::vector<std::uint32_t>* apart = nullptr;  ///< pixels that had better be sampled 2 x 2, and were left out; null:
                                                ///< none may be
};

/// What the first hit of a sample saw, for telling pixels apart.
struct SampleView {
  std::uint32_t chart = 0;
  std::uint32_t lit = 0;            ///< bit l: light l reaches the place (lights beyond 32 share the last bit)
  Vec3 position, geometric_normal;  ///< world space
};

Ray camera_ray(const CameraRays& camera, const CameraSample& sample);

/// Shoots the rays of `traced.samples`.
void trace_samples(const FrameContext& frame, TracedSamples& traced, RenderCounts& counts);

/// Adds the light of the samples `members` (indices into `traced`) to `pixels`. `views`, if not null, receives one
/// entry a sample of `traced`.
void shade_samples(const FrameContext& frame, const TracedSamples& traced, std::span<const std::uint32_t> members,
                   const PixelSums& pixels, RenderCounts& counts, std::vector<SampleView>* views = nullptr);
/// The same for all samples.
void shade_samples(const FrameContext& frame, const TracedSamples& traced, const PixelSums& pixels,
                   RenderCounts& counts, std::vector<SampleView>* views = nullptr);

/// Part of the light that passes along each ray, from `from` on; `widths` are the world-space widths of the beams.
std::vector<Rgb> transmittance_along(const FrameContext& frame, std::vector<Ray> rays, std::span<const float> widths,
                                     RenderCounts& counts);

}  // namespace redmap
