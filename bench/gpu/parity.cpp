#include "gpu/parity.h"

#include <algorithm>

#include "bake/bake.h"
#include "device/device.h"
#include "gpu/device_renderer.h"
#include "metrics/compare.h"
#include "quality/bench_scene.h"
#include "scene/camera_rays.h"
#include "surface/mesh.h"

namespace redmap::bench {

namespace {

/// Pixels all of whose samples see one chart of one object in the same light. As many samples as find the edges for
/// which the CPU takes more rays than a device. What the shader is does not matter: a white one is fastest.
Image interior_of(Scene scene) {
  for (Object& object : scene.objects) object.shader = make_library_shader("white");
  RenderOptions options;
  options.method = Method::kSupersample;
  options.spp = 36;
  options.classify = true;
  const RenderedFrame frame = Renderer(scene, options, std::vector<ObjectData>(scene.objects.size())).render(scene, 1);
  Image mask(frame.image.width, frame.image.height, 1);
  for (std::size_t i = 0; i < mask.pixels(); ++i)
    mask.data[i] = frame.classes[i] == PixelClass::kInterior ? 1.0f : 0.0f;
  return mask;
}

/// `scene` with its camera moved sideways and up by parts of a pixel.
Scene nudged(const Scene& scene, float right, float up) {
  Scene result = scene;
  const CameraRays rays = make_camera_rays(scene.camera);
  const Vec3 step = (rays.right_per_pixel * right - rays.down_per_pixel * up) * length(scene.camera.position);
  result.camera.position = scene.camera.position + step;
  result.camera.look_at = scene.camera.look_at + step;
  return result;
}

float squared_distance(const float* a, const float* b) {
  const Vec3 apart = Vec3{a[0], a[1], a[2]} - Vec3{b[0], b[1], b[2]};
  return dot(apart, apart);
}

/// What the CPU renders, by pixel the nearest to `found` of five pictures whose cameras stand a ten thousandth of a
/// pixel apart. A sample on an edge of a shader falls on either side of it by rounding: neither side is wrong, and
/// one of them, 1/100 of the picture's range in RMSE at this size, would hide everything else.
Image nearest_on_cpu(const Scene& scene, Renderer& on_cpu, const Image& found) {
  constexpr float kNudge = 1e-4f;
  Image nearest = on_cpu.render(scene, 1).image;
  for (const auto [right, up] : {Vec2{kNudge, 0}, Vec2{-kNudge, 0}, Vec2{0, kNudge}, Vec2{0, -kNudge}}) {
    const Image other = on_cpu.render(nudged(scene, right, up), 1).image;
    for (std::size_t i = 0; i < nearest.data.size(); i += 3)
      if (squared_distance(&other.data[i], &found.data[i]) < squared_distance(&nearest.data[i], &found.data[i]))
        std::copy_n(&other.data[i], 3, &nearest.data[i]);
  }
  return nearest;
}

/// Interior also of what is seen when nothing that lets light pass stands in front, one object less at a time.
Image interior_through(Scene scene) {
  Image mask = interior_of(scene);
  for (std::size_t i = 0; i < scene.objects.size();) {
    if (!scene.objects[i].shader->info().transmits) {
      ++i;
      continue;
    }
    scene.objects.erase(scene.objects.begin() + static_cast<std::ptrdiff_t>(i));
    const Image behind = interior_of(scene);
    for (std::size_t p = 0; p < mask.data.size(); ++p) mask.data[p] *= behind.data[p];
  }
  return mask;
}

/// Four corners, facing +z.
std::shared_ptr<const Surface> make_wall(float half) {
  TriangleMesh wall;
  wall.positions = {{-half, -half, 0}, {half, -half, 0}, {half, half, 0}, {-half, half, 0}};
  wall.uv = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  wall.triangles = wall.uv_triangles = {{0, 1, 2}, {0, 2, 3}};
  return make_mesh_surface(std::move(wall));
}

Object make_object(const std::shared_ptr<const Surface>& surface, const std::shared_ptr<const Shader>& shader,
                   Vec3 translate) {
  Object object;
  object.name = shader->info().name;
  object.surface = surface, object.shader = shader;
  object.transform.translate = translate;
  return object;
}

/// Behind glass of `radius`: something opaque, more glass, and a wall that light falls onto through all of them. The
/// opaque one shades no glass: the edge of its shadow inside some would be as soft as a device's shadow maps are, where
/// no mask sees it.
std::vector<Object> behind_glass(const std::shared_ptr<const Shader>& shader, float radius) {
  const auto ball = make_sphere(0.25f * radius);
  return {make_object(ball, make_library_shader("checker"), Vec3{-0.2f, -0.15f, -1.3f} * radius),
          make_object(ball, shader, Vec3{0.2f, 0.1f, -1.3f} * radius),
          make_object(make_wall(1.5f * radius), make_library_shader("white"), Vec3{0, 0, -1.6f} * radius)};
}

ParityRow compare_at(const Scene& scene, Renderer& on_cpu, DeviceRenderer& on_device) {
  on_device.render(scene, 1);
  const Image found = on_device.picture();
  const Image expected = nearest_on_cpu(scene, on_cpu, found);
  const Image mask = interior_through(scene);
  CompareOptions compare;
  compare.mask = &mask, compare.flip = false;
  const Comparison difference = compare_images(found, expected, compare);
  ParityRow row;
  row.rmse = difference.rmse, row.max_error = difference.max_error;
  return row;
}

ObjectData bake_object(const Object& object, int size) {
  BakeOptions options;
  options.size = size;
  ObjectData data;
  data.map = std::make_shared<const ReductionMap>(bake(*object.surface, *object.shader, options));
  return data;
}

/// Of one shader at all distances, each told to `add`; false where that says so.
template <typename Add>
bool measure_shader(const std::shared_ptr<Device>& device, const std::shared_ptr<const Surface>& surface,
                    const std::string& name, const ParityOptions& options, const Add& add) {
  const auto shader = make_library_shader(name);
  const std::vector<Object> behind =
      shader->info().transmits ? behind_glass(shader, bounding_radius(*surface)) : std::vector<Object>{};
  const auto scene_at = [&](double distance) {
    Scene scene = make_bench_scene(surface, shader, options.map_size, distance, 0, options.pixels);
    scene.objects.insert(scene.objects.end(), behind.begin(), behind.end());
    return scene;
  };
  const Scene first = scene_at(1);
  std::vector<ObjectData> data;
  for (const Object& object : first.objects) data.push_back(bake_object(object, options.map_size));
  RenderOptions on_cpu;
  on_cpu.method = options.method;
  DeviceRenderOptions on_device;
  on_device.method = options.method;
  Renderer cpu_renderer(first, on_cpu, data);
  DeviceRenderer device_renderer(device, first, on_device, data);
  for (const double distance : options.distances) {
    ParityRow row = compare_at(scene_at(distance), cpu_renderer, device_renderer);
    row.shader = name, row.distance = distance;
    if (!add(row)) return false;
  }
  return true;
}

}  // namespace

std::vector<ParityRow> measure_parity(const std::shared_ptr<const Surface>& surface, const ParityOptions& options) {
  const std::vector<std::string> shaders = options.shaders.empty() ? library_shader_names() : options.shaders;
  const std::shared_ptr<Device> device = Device::open(options.device);
  const double all = static_cast<double>(shaders.size() * options.distances.size());
  std::vector<ParityRow> rows;
  const auto add = [&](const ParityRow& row) {
    rows.push_back(row);
    if (options.progress) options.progress(static_cast<double>(rows.size()) / all);
    return !(options.cancelled && options.cancelled());
  };
  for (const std::string& name : shaders)
    if (!measure_shader(device, surface, name, options, add)) break;
  return rows;
}

}  // namespace redmap::bench
