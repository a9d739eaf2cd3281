// Camera rays and their differentials (Igehy 1999), and where in a pixel they are shot.
#pragma once

#include <cmath>
#include <cstdint>
#include <vector>

#include "base/vec.h"
#include "scene/scene.h"

namespace redmap {

/// A ray through the image plane. It stands for the square of `extent` pixels' side around (x, y), and contributes
/// `weight` of its pixel's value.
struct CameraSample {
  std::uint32_t pixel = 0;  ///< row-major
  float x = 0, y = 0;       ///< image plane, pixels, origin at the top left corner
  float extent = 1;
  float weight = 1;
};

/// A camera with its axes worked out.
struct CameraRays {
  Vec3 origin;
  Vec3 right_per_pixel, down_per_pixel;  ///< step of the unnormalised direction over one pixel
  Vec3 top_left;                         ///< unnormalised direction through (0, 0)
  float pixel_angle = 0;                 ///< radians a pixel spans at the centre

  Vec3 unnormalised(float x, float y) const { return top_left + right_per_pixel * x + down_per_pixel * y; }
};

inline CameraRays make_camera_rays(const Camera& camera) {
  const Vec3 forward = normalized(camera.look_at - camera.position);
  const Vec3 right = normalized(cross(forward, camera.up));
  const Vec3 down = cross(forward, right);
  const float half_height = std::tan(camera.vertical_fov_degrees * (kPi / 360));
  const float pixel = 2 * half_height / static_cast<float>(camera.height);
  CameraRays rays{camera.position, right * pixel, down * pixel, {}, pixel};
  rays.top_left = forward - rays.right_per_pixel * (0.5f * static_cast<float>(camera.width)) -
                  rays.down_per_pixel * (0.5f * static_cast<float>(camera.height));
  return rays;
}

/// Change of the unit direction through (x, y) with x and with y, per pixel.
struct DirectionDifferential {
  Vec3 dx, dy;
};
inline DirectionDifferential direction_differential(const CameraRays& rays, float x, float y) {
  const Vec3 d = rays.unnormalised(x, y);
  const float dd = dot(d, d), scale = 1 / (dd * std::sqrt(dd));
  const auto change = [&](Vec3 step) { return (step * dd - d * dot(d, step)) * scale; };
  return {change(rays.right_per_pixel), change(rays.down_per_pixel)};
}

/// Appends `columns` x `rows` stratified samples of one pixel. `jitter_seed` 0 puts them at the centres of the strata.
void append_pixel_samples(std::uint32_t pixel, int image_width, int columns, int rows, std::uint64_t jitter_seed,
                          std::vector<CameraSample>& samples);

/// The most nearly square columns x rows = spp.
struct Strata {
  int columns, rows;
};
Strata strata_of(int spp);

}  // namespace redmap
