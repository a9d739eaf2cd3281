#include "verify/pixel_case.h"

#include <algorithm>
#include <cmath>

#include "base/random.h"
#include "map/pyramid.h"
#include "render/hit_footprint.h"

namespace redmap {

namespace {

constexpr float kDegrees = 180 / kPi;
/// Cameras stand this many radii of the object from its centre: no wide angles, which no pixel has.
constexpr float kNearest = 3, kFarthest = 6;
/// Pixels wider than this part of the object's radius see no one place of it.
constexpr float kWidest = 0.5f;

/// Even over the unit sphere (Archimedes: evenly in height).
Vec3 random_direction(Random& random) {
  const float z = 2 * random.next_float() - 1, azimuth = 2 * kPi * random.next_float();
  const float r = std::sqrt(std::max(0.0f, 1 - z * z));
  return {r * std::cos(azimuth), r * std::sin(azimuth), z};
}

struct Seen {
  Ray ray;
  RayHit hit;
  SurfaceHit surface;  ///< geometric normal towards the viewer
};

/// A ray at the object from any side, even over its outline.
std::optional<Seen> look_at_object(const Scene& scene, const Tracer& tracer, Vec3 centre, float radius,
                                   Random& random) {
  const Vec3 from = random_direction(random);
  const Frame screen = make_frame(from, random_direction(random));
  const float r = radius * std::sqrt(random.next_float()), angle = 2 * kPi * random.next_float();
  const Vec3 target = centre + screen.x * (r * std::cos(angle)) + screen.y * (r * std::sin(angle));
  Seen seen;
  seen.ray.origin = centre + from * (radius * (kNearest + (kFarthest - kNearest) * random.next_float()));
  seen.ray.direction = normalized(target - seen.ray.origin);
  tracer.intersect({&seen.ray, 1}, {&seen.hit, 1});
  if (seen.hit.object == kNoObject) return std::nullopt;
  scene.objects.front().surface->complete({&seen.hit.where, 1}, {&seen.surface, 1});
  if (dot(seen.surface.geometric_normal, seen.ray.direction) > 0)
    seen.surface.geometric_normal = -seen.surface.geometric_normal, seen.surface.normal = -seen.surface.normal;
  return seen;
}

/// A light from anywhere above the place; nothing if the object is in its way.
std::optional<Light> light_from_above(const Tracer& tracer, const SurfaceHit& hit, float radius, Random& random) {
  constexpr float kOffset = 2e-4f;  // twice what shadow rays of a frame keep from the surface
  Light light;
  light.type = Light::Type::kDirectional;
  light.intensity = Rgb{1, 1, 1} * kPi;
  light.to_light = random_direction(random);
  if (dot(light.to_light, hit.geometric_normal) < 0) light.to_light = -light.to_light;
  const Ray shadow{hit.position + hit.geometric_normal * (kOffset * radius), light.to_light};
  std::uint8_t blocked = 0;
  tracer.occluded({&shadow, 1}, {&blocked, 1});
  if (blocked) return std::nullopt;
  return light;
}

/// A camera of one pixel around the ray, such that `minification` is what is asked for.
Camera camera_of(const Seen& seen, Extent extent, float minification, Random& random) {
  const SurfaceHit& hit = seen.surface;
  const float texel =
      length(cross(hit.dp_du, hit.dp_dv)) / (static_cast<float>(extent.width) * static_cast<float>(extent.height));
  const float cosine = -dot(seen.ray.direction, hit.geometric_normal);
  const float pixel_radians = minification * std::sqrt(texel * cosine) / seen.hit.t;
  Camera camera;
  camera.position = seen.ray.origin;
  camera.look_at = hit.position;
  camera.up = make_frame(seen.ray.direction, random_direction(random)).x;
  camera.vertical_fov_degrees = 2 * std::atan(0.5f * pixel_radians) * kDegrees;
  camera.width = camera.height = 1;
  return camera;
}

/// Footprint of a ray through the pixel's centre that stands for `extent` of its side.
Footprint footprint_of(const Seen& seen, const Camera& camera, float extent) {
  const DirectionDifferential per_pixel = direction_differential(make_camera_rays(camera), 0.5f, 0.5f);
  return camera_footprint(seen.surface, seen.ray.direction, per_pixel, seen.hit.t, extent);
}

}  // namespace

Scene scene_of(const Object& object) {
  Scene scene;
  scene.objects.push_back(object);
  scene.objects.front().transform = {};
  return scene;
}

Scene scene_of(const Scene& scene, const PixelCase& pixel) {
  Scene with = scene;
  with.camera = pixel.camera;
  with.lights = {pixel.light};
  return with;
}

std::optional<PixelCase> draw_pixel(const Scene& scene, const Tracer& tracer, const ReductionMap& map, Quality quality,
                                    float minification, std::uint64_t seed) {
  const Surface& surface = *scene.objects.front().surface;
  const float radius = 0.5f * length(surface.upper() - surface.lower());
  Random random(seed);
  const float wanted = minification * std::exp2(random.next_float() - 0.5f);
  const auto seen = look_at_object(scene, tracer, (surface.lower() + surface.upper()) * 0.5f, radius, random);
  if (!seen) return std::nullopt;
  const auto light = light_from_above(tracer, seen->surface, radius, random);
  if (!light) return std::nullopt;

  const Extent extent = map.weights.extent(0);
  PixelCase pixel;
  pixel.camera = camera_of(*seen, extent, wanted, random), pixel.light = *light;
  pixel.seed = seed, pixel.where = seen->hit.where;
  const float width = seen->hit.t * pixel.camera.vertical_fov_degrees / kDegrees;
  if (!(width > 0 && width < kWidest * radius)) return std::nullopt;
  const FootprintAxes axes = footprint_axes(footprint_of(*seen, pixel.camera, 1), extent);
  const float ray_extent = quality == Quality::kFast ? 1.0f : 0.5f;
  pixel.position = seen->surface.position, pixel.uv = seen->surface.uv;
  pixel.minification = std::sqrt(axes.major * axes.minor);
  pixel.anisotropy = axes.major / std::max(axes.minor, 1e-6f * axes.major);
  pixel.level = plan_lookup(footprint_of(*seen, pixel.camera, ray_extent), extent, map.weights.levels(),
                            LookupFilter::kVarianceMatched)
                    .level;
  const Vec3 half = normalized(light->to_light - seen->ray.direction);
  pixel.half_degrees = std::acos(std::clamp(dot(half, seen->surface.normal), -1.0f, 1.0f)) * kDegrees;
  return pixel;
}

}  // namespace redmap
