#include "gpu/parity.h"

#include "bake/bake.h"
#include "device/device.h"
#include "gpu/device_renderer.h"
#include "metrics/compare.h"
#include "quality/bench_scene.h"

namespace redmap::bench {

namespace {

/// Pixels all of whose samples see one chart of one object in the same light. As many samples as find the edges for
/// which the CPU takes more rays than a device.
Image interior_of(const Scene& scene) {
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

ParityRow compare_at(const Scene& scene, Renderer& on_cpu, DeviceRenderer& on_device) {
  const Image expected = on_cpu.render(scene, 1).image;
  on_device.render(scene, 1);
  const Image found = on_device.picture();
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
    if (!library_shader_info(name).transmits && !library_shader_info(name).turns_tangents) names.push_back(name);
  return names;
}

std::vector<ParityRow> measure_parity(const ParityOptions& options) {
  const std::vector<std::string> shaders = options.shaders.empty() ? device_shaders() : options.shaders;
  const std::shared_ptr<Device> device = Device::open(options.device);
  const auto surface = make_bench_surface(options.object, options.models);
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
    DeviceRenderer device_renderer(device, first, on_device, {map});
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
