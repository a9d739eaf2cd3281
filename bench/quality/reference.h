// What methods are measured against: supersampled references, whose own residual is known, and flicker beside them.
#pragma once

#include <span>
#include <vector>

#include "error_sums.h"
#include "render/renderer.h"

namespace redmap::bench {

/// The mean of two independent halves of `spp` samples a pixel together, with random numbers that no method shares.
/// `classes` become what the first half saw; the difference of the halves is added to `between_halves`, and half of it
/// is the deviation of the reference.
Image render_reference(const Scene& scene, const std::vector<ObjectData>& data, int spp, int frame,
                       std::vector<PixelClass>& classes, ErrorSums& between_halves);

/// 1 where a pixel is interior or on a seam.
Image interior_mask(const Image& image, std::span<const PixelClass> classes);

/// Degrees a frame at the fast speed, and pixels a frame at the slow one, where crawl lives.
inline constexpr double kFastDegrees = 1.0, kSlowPixels = 0.2;

/// Flicker of every method over `frames` frames, with one reference for all; frame i is `scene_at(i)`.
std::vector<double> measure_flicker(const std::function<Scene(int)>& scene_at, const std::vector<ObjectData>& data,
                                    const std::vector<RenderOptions>& methods, int frames, int reference_spp);

}  // namespace redmap::bench
