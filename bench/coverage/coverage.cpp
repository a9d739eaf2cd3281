#include "coverage/coverage.h"

#include <algorithm>
#include <atomic>
#include <cmath>

#include "bake/bake.h"
#include "base/error.h"
#include "base/parallel.h"
#include "base/random.h"
#include "map/pyramid.h"
#include "quality/bench_scene.h"
#include "quality/reference.h"
#include "render/hit_footprint.h"
#include "render/wavefront.h"

namespace redmap::bench {

namespace {

/// Random numbers of held-out scenes: none is shared with what made the certificates.
constexpr std::uint64_t kHeldOut = 0x68656c646f7574;

Vec3 random_direction(Random& random) {
  const float z = 2 * random.next_float() - 1, azimuth = 2 * kPi * random.next_float();
  const float r = std::sqrt(std::max(0.0f, 1 - z * z));
  return {r * std::cos(azimuth), r * std::sin(azimuth), z};
}

/// A view of the object from a random side and distance, of a random part of it, under a random light. `rows`: what is
/// certified.
Scene make_held_out_scene(const Object& object, const std::vector<Certificate::Row>& rows,
                          const CoverageOptions& options, int view, Random& random) {
  const double octaves = std::log2(rows.back().minification / rows.front().minification);
  const double minification = rows.front().minification * std::exp2(octaves * random.next_float());
  Scene scene =
      make_bench_scene(object.surface, object.shader, options.map_size, minification, view, options.frame_pixels);
  scene.objects.front().transform.rotate_degrees.x = 360 * random.next_float();
  scene = turned(scene, 0);
  const float radius = bounding_radius(*object.surface);
  const Vec3 aside{2 * random.next_float() - 1, 2 * random.next_float() - 1, 0};
  scene.camera.look_at = aside * (0.7f * radius);
  // So far away that its irradiance is pi everywhere on the object, within a few per cent.
  const float distance = 40 * radius;
  scene.lights.front().position = random_direction(random) * distance;
  scene.lights.front().intensity = Rgb{1, 1, 1} * (kPi * distance * distance);
  return scene;
}

/// What a certificate asks of a pixel.
struct PixelFacts {
  bool lit = false;
  float minification = 0, half_degrees = 0;
};

PixelFacts look_at_pixel(const Scene& scene, const Tracer& tracer, Extent extent, int x, int y) {
  const CameraRays camera = make_camera_rays(scene.camera);
  const CameraSample sample{0, static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f, 1, 1};
  const Ray ray = camera_ray(camera, sample);
  RayHit hit;
  tracer.intersect({&ray, 1}, {&hit, 1});
  PixelFacts facts;
  if (hit.object == kNoObject) return facts;
  SurfaceHit surface;
  scene.objects.front().surface->complete({&hit.where, 1}, {&surface, 1});
  const Placement& placement = tracer.placement(0);
  const DirectionDifferential world = direction_differential(camera, sample.x, sample.y);
  const Footprint footprint = camera_footprint(
      surface, placement.direction_object(ray.direction),
      {placement.direction_object(world.dx), placement.direction_object(world.dy)}, hit.t / placement.scale, 1);
  const FootprintAxes axes = footprint_axes(footprint, extent);
  facts.minification = std::sqrt(axes.major * axes.minor);

  const Vec3 position = placement.point_world(surface.position);
  Vec3 normal = placement.direction_world(surface.normal), face = placement.direction_world(surface.geometric_normal);
  if (dot(face, ray.direction) > 0) normal = -normal, face = -face;
  const Vec3 to_light = normalized(scene.lights.front().position - position);
  const Vec3 half = normalized(to_light - ray.direction);
  facts.half_degrees = std::acos(std::clamp(dot(half, normal), -1.0f, 1.0f)) * (180 / kPi);
  const Ray shadow{position + face * (1e-3f * bounding_radius(*scene.objects.front().surface)), to_light};
  std::uint8_t blocked = 0;
  tracer.occluded({&shadow, 1}, {&blocked, 1});
  facts.lit = dot(face, to_light) > 0 && !blocked;
  return facts;
}

/// Held-out pixels of one frame.
struct HeldOut {
  std::vector<double> errors, bounds;
  int beyond = 0;
};

/// Up to pixels_per_scene random pixels of a frame.
HeldOut hold_out(const Scene& scene, int view, const std::shared_ptr<const ReductionMap>& map,
                 const CoverageOptions& options, Random& random) {
  const std::vector<ObjectData> data{{map, nullptr, nullptr}};
  RenderOptions render;
  render.quality = options.verify.quality;
  const Image frame = Renderer(scene, render, data).render(scene, view).image;
  std::vector<PixelClass> classes;
  ErrorSums between_halves;
  const Image reference = render_reference(scene, data, options.reference_spp, view, classes, between_halves);
  Tracer tracer(scene);
  tracer.set_frame(scene);
  HeldOut held_out;
  constexpr int kDraws = 2000;
  for (int draw = 0; draw < kDraws; ++draw) {
    if (static_cast<int>(held_out.errors.size()) == options.pixels_per_scene) break;
    const int x = static_cast<int>(random.below(static_cast<std::uint32_t>(frame.width)));
    const int y = static_cast<int>(random.below(static_cast<std::uint32_t>(frame.height)));
    const PixelClass seen = classes[static_cast<std::size_t>(y) * frame.width + x];
    if (seen != PixelClass::kInterior && seen != PixelClass::kSeam) continue;
    const PixelFacts facts = look_at_pixel(scene, tracer, map->weights.extent(0), x, y);
    if (!facts.lit) continue;
    const auto bound = bound_of(*map->certificate, facts.minification, facts.half_degrees);
    if (!bound) {
      ++held_out.beyond;
      continue;
    }
    held_out.errors.push_back(rms(frame.rgb(x, y) - reference.rgb(x, y)));
    held_out.bounds.push_back(*bound);
  }
  return held_out;
}

CoverageRow summarize(const std::vector<HeldOut>& scenes) {
  CoverageRow row;
  for (const HeldOut& scene : scenes) {
    row.pixels += static_cast<int>(scene.errors.size()), row.beyond += scene.beyond;
    for (std::size_t i = 0; i < scene.errors.size(); ++i) {
      const double error = scene.errors[i], bound = scene.bounds[i];
      row.coverage += error <= bound;
      row.mean_error += error, row.rms_error += error * error, row.mean_bound += bound;
    }
  }
  row.coverage /= row.pixels, row.mean_error /= row.pixels, row.mean_bound /= row.pixels;
  row.rms_error = std::sqrt(row.rms_error / row.pixels);
  return row;
}

CoverageRow measure_case(const std::string& object, const std::string& shader, const CoverageOptions& options,
                         const std::function<void()>& scene_done) {
  Object verified;
  verified.name = object;
  verified.surface = make_bench_surface(object, options.models);
  verified.shader = make_library_shader(shader);
  BakeOptions bake_options;
  bake_options.size = options.map_size;
  auto map = std::make_shared<ReductionMap>(bake(*verified.surface, *verified.shader, bake_options));
  map->certificate = verify(verified, map, options.verify).certificate;

  if (map->certificate->rows.empty()) throw Error("coverage: {} with {}: nothing is certified", object, shader);
  std::vector<HeldOut> scenes(options.scenes);
  parallel_for(scenes.size(), [&](std::size_t view) {
    if (options.cancelled && options.cancelled()) return;
    Random random(hash64(kHeldOut, options.verify.seed, view));
    const Scene scene = make_held_out_scene(verified, map->certificate->rows, options, static_cast<int>(view), random);
    scenes[view] = hold_out(scene, static_cast<int>(view), map, options, random);
    scene_done();
  });
  if (options.cancelled && options.cancelled()) throw Error("the bench was cancelled");
  CoverageRow row = summarize(scenes);
  if (row.pixels == 0) throw Error("coverage: {} with {}: no held-out pixel is interior and lit", object, shader);
  row.object = object, row.shader = shader;
  return row;
}

}  // namespace

std::vector<CoverageRow> measure_coverage(const CoverageOptions& options) {
  std::vector<CoverageRow> rows;
  std::atomic<int> done = 0;
  const auto total = static_cast<double>(options.objects.size() * options.shaders.size() * options.scenes);
  for (const std::string& object : options.objects)
    for (const std::string& shader : options.shaders)
      rows.push_back(measure_case(object, shader, options, [&] {
        if (options.progress) options.progress(++done / total);
      }));
  return rows;
}

}  // namespace redmap::bench
