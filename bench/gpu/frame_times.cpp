#include "gpu/frame_times.h"

#include <algorithm>
#include <cmath>

#include "bake/bake.h"
#include "bake/baselines.h"
#include "device/device.h"
#include "gpu/device_renderer.h"
#include "metrics/compare.h"
#include "quality/bench_scene.h"

namespace redmap::bench {

namespace {

constexpr int kRows = 3, kColumns = 5;
/// Between the centres of balls of radius 1.
constexpr float kSpacing = 2.1f;
/// Pixels of the ball that errors are taken on.
constexpr int kErrorPixels = 256;

struct MethodCase {
  Method method;
  int spp;
  bool draws_one_basis = false;
};
constexpr MethodCase kCases[] = {{Method::kOriginal, 1},  {Method::kSupersample, 4}, {Method::kSupersample, 16},
                                 {Method::kMap, 1},       {Method::kMap, 4},         {Method::kMap, 1, true},
                                 {Method::kMap, 4, true}, {Method::kParameters, 1},  {Method::kParameters, 4}};

DeviceRenderOptions options_of(const MethodCase& c) {
  DeviceRenderOptions options;
  options.method = c.method;
  options.quality = c.spp == 1 ? Quality::kFast : Quality::kDefault;
  options.spp = c.method == Method::kMap || c.method == Method::kParameters ? 0 : c.spp;
  options.draws_one_basis = c.draws_one_basis;
  return options;
}

/// `count` shadowed lights on a ring around the view's axis, as bright together as one.
void set_lights(Scene& scene, int count, float distance) {
  scene.lights.clear();
  for (int i = 0; i < count; ++i) {
    const float angle = 2 * kPi * (static_cast<float>(i) + 0.15f) / static_cast<float>(count);
    Light light;
    light.position = normalized(Vec3{0.7f * std::cos(angle), 0.7f * std::sin(angle), 1}) * distance;
    light.intensity = Rgb{1, 1, 1} * (kPi * distance * distance / static_cast<float>(count));
    scene.lights.push_back(light);
  }
}

/// Balls side by side in front of a camera whose pixels are those of `one`, the scene of one ball.
Scene wall_of(const Scene& one, const FrameTimeOptions& options) {
  Scene wall = one;
  wall.objects.clear();
  for (int i = 0; i < kRows * kColumns; ++i) {
    Object ball = one.objects.front();
    ball.transform.translate = {kSpacing * static_cast<float>(i % kColumns - kColumns / 2),
                                kSpacing * static_cast<float>(i / kColumns - kRows / 2), 0};
    wall.objects.push_back(ball);
  }
  // The wall fills the picture's height; the map is what makes two texels a pixel of that.
  const float half = 0.5f * kSpacing * kRows;
  wall.camera.width = options.width, wall.camera.height = options.height;
  wall.camera.vertical_fov_degrees = 2 * std::atan(half / (wall.camera.position.z - 0.5f)) * 180 / kPi;
  return wall;
}

double median_milliseconds(DeviceRenderer& renderer, const Scene& scene, int frames) {
  std::vector<double> seconds;
  renderer.render(scene, 0);
  for (int frame = 1; frame <= frames; ++frame) seconds.push_back(renderer.render(scene, frame));
  std::nth_element(seconds.begin(), seconds.begin() + frames / 2, seconds.end());
  return 1e3 * seconds[frames / 2];
}

/// A picture to be compared with, and where it counts.
struct Reference {
  Image image, mask;
};
Reference make_reference(const Scene& scene, int spp) {
  RenderOptions options;
  options.method = Method::kSupersample;
  options.spp = spp;
  options.classify = true;
  RenderedFrame frame = Renderer(scene, options, std::vector<ObjectData>(scene.objects.size())).render(scene, 1);
  Reference reference{std::move(frame.image), Image(scene.camera.width, scene.camera.height, 1)};
  for (std::size_t i = 0; i < reference.mask.pixels(); ++i)
    reference.mask.data[i] = frame.classes[i] == PixelClass::kInterior ? 1.0f : 0.0f;
  return reference;
}

double error_of(const std::shared_ptr<Device>& device, const Scene& scene, const DeviceRenderOptions& options,
                const ObjectData& data, const Reference& reference) {
  DeviceRenderer renderer(device, scene, options, {data});
  renderer.render(scene, 1);
  CompareOptions compare;
  compare.mask = &reference.mask, compare.flip = false;
  return compare_images(renderer.picture(), reference.image, compare).rmse;
}

}  // namespace

std::vector<FrameTimeRow> measure_frame_times(const FrameTimeOptions& options) {
  const std::shared_ptr<Device> device = Device::open(options.device);
  const auto surface = make_sphere(1);
  std::vector<FrameTimeRow> rows;
  for (const std::string& name : options.shaders) {
    const auto shader = make_library_shader(name);
    BakeOptions bake_options;
    bake_options.size = options.map_size;
    ObjectData data;
    data.map = std::make_shared<const ReductionMap>(bake(*surface, *shader, bake_options));
    const bool has_parameters = shader->info().has_material && !shader->info().emits;
    if (has_parameters)
      data.parameters =
          std::make_shared<const Pyramid<float>>(build_parameter_pyramid(*surface, *shader, options.map_size));
    if (has_parameters && shader->info().perturbs_normals)
      data.slopes = std::make_shared<const Pyramid<float>>(build_slope_pyramid(*surface, *shader, options.map_size));
    Scene one = make_bench_scene(surface, shader, options.map_size, options.minification, 0, kErrorPixels);
    for (const int lights : options.lights) {
      Scene wall = wall_of(one, options);
      set_lights(one, lights, 6), set_lights(wall, lights, 12);
      const Reference reference = make_reference(one, options.reference_spp);
      const std::vector<ObjectData> all(wall.objects.size(), data);
      for (const MethodCase& c : kCases) {
        if (options.cancelled && options.cancelled()) return rows;
        if (c.method == Method::kParameters && !has_parameters) continue;
        const DeviceRenderOptions method = options_of(c);
        FrameTimeRow row{name, lights, c.method, c.draws_one_basis, c.spp};
        DeviceRenderer renderer(device, wall, method, all);
        row.milliseconds_per_frame = median_milliseconds(renderer, wall, options.frames);
        row.rmse_interior = error_of(device, one, method, data, reference);
        rows.push_back(row);
        const double cases = static_cast<double>(options.shaders.size() * options.lights.size() * std::size(kCases));
        if (options.progress) options.progress(static_cast<double>(rows.size()) / cases);
      }
    }
  }
  return rows;
}

}  // namespace redmap::bench
