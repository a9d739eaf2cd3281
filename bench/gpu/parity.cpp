#include "gpu/parity.h"

#include <algorithm>

#include "bake/bake.h"
#include "device/device.h"
#include "gpu/device_renderer.h"
#include "metrics/compare.h"
#include "quality/bench_scene.h"
#include "scene/camera_rays.h"

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

ParityRow compare_at(const Scene& scene, Renderer& on_cpu, DeviceRenderer& on_device) {
  on_device.render(scene, 1);
  const Image found = on_device.picture();
  const Image expected = nearest_on_cpu(scene, on_cpu, found);
  const Image mask = interior_of(scene);
  CompareOptions compare;
  compare.mask = &mask, compare.flip = false;
  const Comparison difference = compare_images(found, expected, compare);
  ParityRow row;
  row.rmse = difference.rmse, row.max_error = difference.max_error;
  return row;
}

}  // namespace

std::vector<std::string> device_shaders() {
  std::vector<std::string> names;
  for (const std::string& name : library_shader_names())
    if (!library_shader_info(name).transmits) names.push_back(name);
  return names;
}

std::vector<ParityRow> measure_parity(const std::shared_ptr<const Surface>& surface, const ParityOptions& options) {
  const std::vector<std::string> shaders = options.shaders.empty() ? device_shaders() : options.shaders;
  const std::shared_ptr<Device> device = Device::open(options.device);
  std::vector<ParityRow> rows;
  for (const std::string& name : shaders) {
    const auto shader = make_library_shader(name);
    BakeOptions bake_options;
    bake_options.size = options.map_size;
    const auto map = std::make_shared<const ReductionMap>(bake(*surface, *shader, bake_options));
    const Scene first = make_bench_scene(surface, shader, options.map_size, 1, 0, options.pixels);
    RenderOptions on_cpu;
    on_cpu.method = options.method;
    DeviceRenderOptions on_device;
    on_device.method = options.method;
    ObjectData data;
    data.map = map;
    Renderer cpu_renderer(first, on_cpu, {data});
    DeviceRenderer device_renderer(device, first, on_device, {data});
    for (const double distance : options.distances) {
      if (options.cancelled && options.cancelled()) return rows;
      const Scene scene = make_bench_scene(surface, shader, options.map_size, distance, 0, options.pixels);
      rows.push_back(compare_at(scene, cpu_renderer, device_renderer));
      rows.back().shader = name, rows.back().distance = distance;
      if (options.progress)
        options.progress(static_cast<double>(rows.size()) /
                         static_cast<double>(shaders.size() * options.distances.size()));
    }
  }
  return rows;
}

}  // namespace redmap::bench
