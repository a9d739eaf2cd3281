#include "bench_scene.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <vector>

#include "base/error.h"
#include "render/hit_footprint.h"
#include "render/wavefront.h"
#include "surface/atlas.h"
#include "surface/mesh.h"

namespace redmap::bench {

namespace {

constexpr float kFieldDegrees = 40;  // 512 pixels over 40 degrees
constexpr float kPixelsPerField = 512;
constexpr float kMargin = 1.15f;  // of the picture around the object's bounding sphere

/// Camera on +z at `distance` from the origin, its picture cropped to the object and to `largest` pixels (0: any
/// number), its pixels all the same angle.
Camera camera_at(float distance, float radius, int largest) {
  const float pixel = 2 * std::tan(kFieldDegrees * kPi / 360) / kPixelsPerField;
  const float half = radius / std::sqrt(std::max(distance * distance - radius * radius, 0.1f * radius * radius));
  const int whole = std::max(8, 2 * static_cast<int>(std::ceil(kMargin * half / pixel)));
  const int size = largest > 0 ? std::min(whole, largest) : whole;
  Camera camera;
  camera.position = {0, 0, distance};
  camera.width = camera.height = size;
  camera.vertical_fov_degrees = 2 * std::atan(0.5f * pixel * static_cast<float>(size)) * 180 / kPi;
  return camera;
}

}  // namespace

float bounding_radius(const Surface& surface) {
  std::vector<Vec3> places;
  if (surface.mesh()) {
    places = surface.mesh()->positions;
  } else {
    constexpr int kSteps = 32;
    std::vector<HitCoordinates> where;
    for (int j = 0; j <= kSteps; ++j)
      for (int i = 0; i < kSteps; ++i)
        where.push_back({0, {static_cast<float>(i) / kSteps, static_cast<float>(j) / kSteps}});
    std::vector<SurfaceHit> hits(where.size());
    surface.complete(where, hits);
    for (const SurfaceHit& hit : hits) places.push_back(hit.position);
  }
  const Vec3 centre = (surface.lower() + surface.upper()) * 0.5f;
  float radius = 0;
  for (Vec3 place : places) radius = std::max(radius, length(place - centre));
  return radius;
}

std::shared_ptr<const Surface> make_bench_surface(const std::string& object, const std::filesystem::path& models) {
  if (object == "sphere") return make_sphere(1);
  if (object == "cylinder") return make_cylinder(0.6f, 1.6f);
  static const std::map<std::string, std::string> kFiles = {{"bunny", "bunny_10k.obj"}, {"dragon", "dragon_20k.obj"}};
  const auto file = kFiles.find(object);
  if (file == kFiles.end()) throw Error("there is no object '{}': expected sphere, cylinder, bunny or dragon", object);
  const std::filesystem::path path = models / file->second;
  if (!std::filesystem::exists(path)) throw Error("{}: no such file; scripts/fetch_models.sh makes it", path.string());
  TriangleMesh mesh = read_mesh(path);
  if (mesh.uv.empty()) unwrap_cached(mesh, models);
  if (mesh.normals.empty()) compute_normals(mesh);
  return make_mesh_surface(std::move(mesh));
}

double median_minification(const Scene& scene) {
  Tracer tracer(scene);
  tracer.set_frame(scene);
  const Object& object = scene.objects.front();
  const Extent extent = object.surface->map_extent(object.map_size);
  const CameraRays camera = make_camera_rays(scene.camera);
  std::vector<CameraSample> samples;
  for (int y = 0; y < scene.camera.height; ++y)
    for (int x = 0; x < scene.camera.width; ++x)
      samples.push_back({0, static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f, 1, 1});
  std::vector<Ray> rays;
  for (const CameraSample& sample : samples) rays.push_back(camera_ray(camera, sample));
  std::vector<RayHit> hits(rays.size());
  tracer.intersect(rays, hits);

  std::vector<double> minification;
  const Placement& placement = tracer.placement(0);
  for (std::size_t i = 0; i < hits.size(); ++i) {
    if (hits[i].object == kNoObject) continue;
    SurfaceHit hit;
    object.surface->complete({&hits[i].where, 1}, {&hit, 1});
    const DirectionDifferential world = direction_differential(camera, samples[i].x, samples[i].y);
    const Footprint footprint = camera_footprint(
        hit, placement.direction_object(rays[i].direction),
        {placement.direction_object(world.dx), placement.direction_object(world.dy)}, hits[i].t / placement.scale, 1);
    minification.push_back(std::sqrt(std::abs(static_cast<double>(cross(footprint.duv_dx, footprint.duv_dy))) *
                                     extent.width * extent.height));
  }
  if (minification.empty()) throw Error("no pixel hits the object");
  std::nth_element(minification.begin(), minification.begin() + minification.size() / 2, minification.end());
  return minification[minification.size() / 2];
}

Scene make_bench_scene(const std::shared_ptr<const Surface>& surface, const std::shared_ptr<const Shader>& shader,
                       int map_size, double minification, int view, int largest) {
  Scene scene;
  Object object;
  object.name = "object";
  object.surface = surface, object.shader = shader, object.map_size = map_size;
  // Views are spread by the golden angle, so that no two show the same side.
  object.transform.rotate_degrees = {10.0f * std::sin(1.7f * static_cast<float>(view)),
                                     17.0f + 137.508f * static_cast<float>(view), 0};
  scene.objects.push_back(std::move(object));
  scene = turned(scene, 0);
  // Irradiance about pi at the object: a white Lambert surface facing the light is about 1.
  const float radius = bounding_radius(*surface);
  Light light;
  light.position = normalized(Vec3{0.45f, 0.55f, 1}) * (6 * radius);
  light.intensity = Rgb{1, 1, 1} * (kPi * 25 * radius * radius);
  scene.lights.push_back(light);
  scene.background = {0.35f, 0.45f, 0.6f};

  place_camera(scene, minification, largest);
  return scene;
}

void place_camera(Scene& scene, double minification, int largest) {
  // The footprint grows in proportion to the distance from the near side: a few corrections are exact.
  const float radius = bounding_radius(*scene.objects.front().surface);
  float distance = 4 * radius;
  for (int correction = 0; correction < 4; ++correction) {
    scene.camera = camera_at(distance, radius, largest);
    const double now = median_minification(scene);
    distance = 0.5f * radius + (distance - 0.5f * radius) * static_cast<float>(minification / now);
    distance = std::max(distance, 1.2f * radius);
  }
  scene.camera = camera_at(distance, radius, largest);
}

Scene turned(const Scene& scene, double degrees) {
  Scene result = scene;
  Object& object = result.objects.front();
  object.transform.rotate_degrees.y += static_cast<float>(degrees);
  const Vec3 centre = (object.surface->lower() + object.surface->upper()) * 0.5f;
  object.transform.translate = -make_placement(object.transform).direction_world(centre);
  return result;
}

double degrees_for_pixels(const Scene& scene, double pixels) {
  const CameraRays camera = make_camera_rays(scene.camera);
  const double radius = bounding_radius(*scene.objects.front().surface);
  const double pixel = camera.pixel_angle * (scene.camera.position.z - radius);
  return pixels * pixel / radius * 180 / kPi;
}

}  // namespace redmap::bench
