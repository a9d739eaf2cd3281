// Pixels to put a map to the test with: as they are met in frames, of any view, distance and light, but each alone.
#pragma once

#include <cstdint>
#include <optional>

#include "render/renderer.h"
#include "render/tracer.h"
#include "scene/scene.h"

namespace redmap {

/// One pixel of a frame that nobody rendered: a camera of one pixel and a light, in the object's space.
struct PixelCase {
  Camera camera;
  Light light;  ///< directional, irradiance pi (white Lambert that faces it is 1), with shadows
  std::uint64_t seed = 0;
  HitCoordinates where;  ///< what the centre of the pixel sees
  Vec3 position;
  Vec2 uv;
  float minification = 0;  ///< root of pixel footprint area over texel area
  float anisotropy = 1;    ///< of the footprint, in texels: major over minor axis
  int level = 0;           ///< of the pyramid, where the lookup of one of the pixel's rays begins
  float half_degrees = 0;  ///< between the normal and the half vector: how near to a highlight
};

/// A scene of `object` alone, untransformed, without camera and light.
Scene scene_of(const Object& object);

/// The scene with the camera and the light of `pixel`.
Scene scene_of(const Scene& scene, const PixelCase& pixel);

/// A random pixel of about `minification` (within a factor of root 2, evenly in logarithms), decided by `seed` alone:
/// any direction to the object, any of its pixels from there, any light that reaches the place. `tracer` holds
/// `scene`. Nothing where the ray missed, the light is blocked, or the pixel would be wider than the object.
std::optional<PixelCase> draw_pixel(const Scene& scene, const Tracer& tracer, const ReductionMap& map, Quality quality,
                                    float minification, std::uint64_t seed);

}  // namespace redmap
