#include "gpu/device_renderer.h"

#include <algorithm>
#include <bit>
#include <chrono>
#include <cmath>
#include <optional>

#include "gpu/device_object.h"
#include "gpu/shadow_views.h"
#include "scene/layer_limits.h"
#include "scene/object_data.h"
#include "user_shader/stages.h"

namespace redmap {
namespace {

/// No frame takes that long; a device's own watchdog may end it sooner.
constexpr std::chrono::minutes kTimeout{2};

/// Samples of a band, at most: its lists and radiance stay under 48 MB, and its workgroups under 65536.
constexpr int kBandSamples = 1 << 21;

/// Of what the samples of a band carry through layers, at most.
constexpr std::size_t kPathBytes = std::size_t{64} << 20;

/// A sample's vectors: kernels/paths.glsl.
std::size_t path_bytes(const Scene& scene) { return (3 + scene.lights.size()) * sizeof(Vec4); }

/// Samples a side where a map does not reduce: 16 in all, what the paper falls back to.
constexpr int kFallbackSide = 4;

/// Texels of a shadow map a side, by how many of them there are: 64 MB in all, or less.
int shadow_size(int views) { return views <= 4 ? 2048 : views <= 16 ? 1024 : views <= 64 ? 512 : 256; }

int side_of(const DeviceRenderOptions& options) {
  if (options.method == Method::kSupersample || (options.method == Method::kOriginal && options.spp > 0))
    return static_cast<int>(std::lround(std::sqrt(static_cast<double>(options.spp > 0 ? options.spp : 16))));
  return options.quality == Quality::kFast ? 1 : 2;
}

FrameBlock frame_block(const Scene& scene, int samples, int frame) {
  const CameraRays rays = make_camera_rays(scene.camera);
  FrameBlock block;
  block.eye = {rays.origin, scene.time_seconds};
  block.top_left = {rays.top_left, 0};
  block.right = {rays.right_per_pixel, 0}, block.down = {rays.down_per_pixel, 0};
  block.background = {scene.background.r, scene.background.g, scene.background.b, 1};
  block.picture = {static_cast<std::uint32_t>(scene.camera.width * samples), static_cast<std::uint32_t>(samples),
                   static_cast<std::uint32_t>(scene.lights.size()), static_cast<std::uint32_t>(frame)};
  for (std::size_t l = 0; l < scene.lights.size(); ++l) {
    const Light& light = scene.lights[l];
    const bool point = light.type == Light::Type::kPoint;
    block.lights[l].place = {point ? light.position : light.to_light, point ? 1.0f : 0.0f};
    block.lights[l].intensity = {light.intensity.r, light.intensity.g, light.intensity.b, -1};
  }
  return block;
}

}  // namespace

void require_device_method(const DeviceRenderOptions& options) {
  if (options.method == Method::kPaper)
    throw Error(
        "method paper: expected map, original, supersample or parameters on a device: render it without --device");
  constexpr int kMostSamples = 1024;
  const int side = side_of(options);
  if (options.spp < 0 || options.spp > kMostSamples || (options.spp > 0 && side * side != options.spp))
    throw Error("{} samples a pixel: expected a square number up to {} on a device", options.spp, kMostSamples);
}

namespace {

SceneTraits traits_of(const Scene& scene) {
  return {std::ranges::any_of(scene.lights, &Light::shadows),
          std::ranges::any_of(scene.objects, [](const Object& o) { return o.shader->info().transmits; })};
}

/// Rows of a band of `columns` samples, `samples` a row of pixels.
int rows_of_band(const Scene& scene, int columns, int samples) {
  std::size_t most = kBandSamples;
  if (traits_of(scene).layers) most = std::min(most, kPathBytes / path_bytes(scene));
  return std::clamp(static_cast<int>(most) / columns / samples, 1, scene.camera.height) * samples;
}

}  // namespace

/// What depends on the size of the picture and on how many shadow maps there are.
struct FrameTargets {
  Extent extent;
  int samples, shadow_layers, columns, band_rows, bands;
  SharedBytes frame, views;
  LocalBuffer lists, radiance, picture, paths, onward;
  RenderTarget seen, shadows;
  DeviceBuffer read_back, onward_here;
  Bindings resolve_bindings;
  std::optional<Bindings> advance_bindings;

  /// `advance`: null unless any object lets light pass.
  FrameTargets(const Device& device, const ComputePipeline& resolve, const ComputePipeline* advance, const Scene& scene,
               int samples_a_side);
  bool fits(const Scene& scene) const {
    return scene.camera.width == extent.width && scene.camera.height == extent.height &&
           shadow_view_count(scene) == shadow_layers;
  }
};

FrameTargets::FrameTargets(const Device& device, const ComputePipeline& resolve, const ComputePipeline* advance,
                           const Scene& scene, int samples_a_side)
    : extent{scene.camera.width, scene.camera.height},
      samples(samples_a_side),
      shadow_layers(shadow_view_count(scene)),
      columns(extent.width * samples),
      band_rows(rows_of_band(scene, columns, samples)),
      bands((extent.height * samples + band_rows - 1) / band_rows),
      frame(device, sizeof(FrameBlock)),
      views(device, sizeof(ViewBlock) * (shadow_layers + bands)),
      lists(device, sizeof(std::uint32_t) * (kListsHead + std::max(2 * columns * band_rows, kMaxChannels))),
      radiance(device, 3 * sizeof(float) * columns * band_rows),
      picture(device, sizeof(Vec4) * extent.width * extent.height),
      paths(device, advance ? path_bytes(scene) * columns * band_rows : 4),
      onward(device, sizeof(std::uint32_t)),
      seen(device, advance ? TargetKind::kLayers : TargetKind::kNumbers, {columns, band_rows}),
      shadows(device, TargetKind::kDepth,
              shadow_layers > 0 ? Extent{shadow_size(shadow_layers), shadow_size(shadow_layers)} : Extent{1, 1},
              std::max(shadow_layers, 1)),
      read_back(device, picture.size()),
      onward_here(device, onward.size()),
      resolve_bindings(resolve) {
  resolve_bindings.add(frame.buffer()).add(picture).add(lists).add(lists).add(radiance);
  for (int unused = kParametersBinding; unused < kObjectBuffers; ++unused) resolve_bindings.add(lists);
  resolve_bindings.add(seen);
  if (!advance) return;
  advance_bindings.emplace(*advance);
  advance_bindings->add(frame.buffer()).add(onward).add(lists).add(lists).add(radiance);
  for (int unused = kParametersBinding; unused < kPathsBinding; ++unused) advance_bindings->add(lists);
  advance_bindings->add(paths).add(seen).add_depth(seen);
}

struct DeviceRenderer::Impl {
  std::shared_ptr<Device> device;
  DeviceRenderOptions options;
  int samples;
  std::size_t lights;
  SceneTraits traits;
  PipelineCache cache;
  const ComputePipeline& resolve;
  const ComputePipeline* advance = nullptr;  ///< only in layers
  std::vector<std::string> names;
  std::vector<DeviceObject> objects;
  std::unique_ptr<FrameTargets> targets;
  mutable CommandList commands;

  Impl(std::shared_ptr<Device> opened, const Scene& scene, const DeviceRenderOptions& chosen, int side,
       const std::vector<ObjectData>& data);
  void make_targets(const Scene& scene);
  void record_uploads(const Scene& scene, int frame);
  void record_shadows();
  void render_band(const CameraRays& camera, int band);
  void record_seen(int band);
  void record_shading(const BandCall& call, const CameraRays& camera);
  void render_layers(const BandCall& call, const CameraRays& camera, int band);
  void check_shaders();
};

DeviceRenderer::Impl::Impl(std::shared_ptr<Device> opened, const Scene& scene, const DeviceRenderOptions& chosen,
                           int side, const std::vector<ObjectData>& data)
    : device(std::move(opened)),
      options(chosen),
      samples(side),
      lights(scene.lights.size()),
      traits(traits_of(scene)),
      cache(device),
      resolve(cache.compute(resolve_text(traits.layers), {kObjectBuffers, 1, sizeof(BandCall)})),
      commands(*device) {
  traits.is_fast = chosen.quality == Quality::kFast;
  if (traits.layers) advance = &cache.compute(advance_text(), {kObjectBuffers, 2, sizeof(BandCall)});
  std::uint32_t next = 1;
  for (std::size_t i = 0; i < scene.objects.size(); ++i) {
    objects.emplace_back(cache, scene.objects[i], data[i], traits, next, static_cast<std::uint32_t>(i));
    names.push_back(scene.objects[i].shader->info().name);
    next += objects.back().numbers();
  }
  make_targets(scene);
}

void DeviceRenderer::Impl::make_targets(const Scene& scene) {
  targets.reset();  // its memory first
  targets = std::make_unique<FrameTargets>(*device, resolve, advance, scene, samples);
  const FrameMemory memory{&targets->frame, &targets->views, &targets->lists,  &targets->radiance,
                           &targets->paths, &targets->seen,  &targets->shadows};
  targets->frame.set(frame_block(scene, samples, 0));
  targets->frame.record_upload(commands);
  commands.fill(targets->lists, 0);
  // Cleared, so that they may be read where nothing is ever drawn.
  for (int layer = 0; layer < std::max(targets->shadow_layers, 1); ++layer)
    commands.begin_target(targets->shadows, layer), commands.end_target();
  commands.begin_target(targets->seen), commands.end_target();
  for (DeviceObject& object : objects) object.attach(memory, commands);
  commands.run(kTimeout);
  for (DeviceObject& object : objects) object.prepare(cache);
}

void DeviceRenderer::Impl::record_uploads(const Scene& scene, int frame) {
  FrameTargets& to = *targets;
  FrameBlock block = frame_block(scene, samples, frame);
  const std::vector<ViewBlock> shadow = shadow_views(scene, to.shadows.extent().width, block);
  const Ball ball = ball_around(scene);
  to.frame.set(block);
  for (std::size_t i = 0; i < shadow.size(); ++i) to.views.set(shadow[i], i);
  for (int band = 0; band < to.bands; ++band)
    to.views.set(camera_view(scene.camera, ball, samples, band * to.band_rows, to.band_rows), shadow.size() + band);
  to.frame.record_upload(commands), to.views.record_upload(commands);
  for (std::size_t i = 0; i < objects.size(); ++i) {
    objects[i].place(scene.objects[i].transform);
    objects[i].record_upload(commands);
  }
}

void DeviceRenderer::Impl::record_shadows() {
  for (int layer = 0; layer < targets->shadow_layers; ++layer) {
    commands.begin_target(targets->shadows, layer);
    for (const DeviceObject& object : objects)
      if (!object.transmits()) object.record_draw(commands, TargetKind::kDepth, static_cast<std::uint32_t>(layer));
    commands.end_target();
  }
}

void DeviceRenderer::Impl::record_seen(int band) {
  const FrameTargets& to = *targets;
  commands.begin_target(to.seen);
  for (const DeviceObject& object : objects)
    object.record_draw(commands, traits.layers ? TargetKind::kLayers : TargetKind::kNumbers,
                       static_cast<std::uint32_t>(to.shadow_layers + band));
  commands.end_target();
}

void DeviceRenderer::Impl::record_shading(const BandCall& call, const CameraRays& camera) {
  const int columns = targets->columns;
  if (traits.layers && traits.shadows) {
    for (const DeviceObject& object : objects) object.record_receivers(commands, call, camera, samples, columns);
    for (const DeviceObject& object : objects) object.record_passing(commands, call, columns);
  }
  for (const DeviceObject& object : objects) object.record_shading(commands, call, camera, samples, columns);
}

/// Until no sample goes on behind what it saw.
void DeviceRenderer::Impl::render_layers(const BandCall& call, const CameraRays& camera, int band) {
  const FrameTargets& to = *targets;
  commands.fill(to.radiance, 0);
  // All light arrives, from however near.
  commands.fill(to.paths, std::bit_cast<std::uint32_t>(1.0f));
  const std::uint32_t all = static_cast<std::uint32_t>(to.columns) * call.rows;
  std::uint32_t goes_on = 1;
  for (int layer = 0; layer < kMaxLayers && goes_on; ++layer) {
    record_seen(band);
    record_shading(call, camera);
    commands.fill(to.onward, 0);
    commands.dispatch(*advance, *to.advance_bindings, bytes_of(call), Workgroups{(all + 63) / 64, 1});
    commands.copy(to.onward, to.onward_here, sizeof goes_on);
    commands.run(kTimeout);
    std::memcpy(&goes_on, to.onward_here.data(), sizeof goes_on);
  }
}

void DeviceRenderer::Impl::render_band(const CameraRays& camera, int band) {
  const FrameTargets& to = *targets;
  BandCall call;
  call.first_row = static_cast<std::uint32_t>(band * to.band_rows);
  call.rows = static_cast<std::uint32_t>(std::min(to.band_rows, to.extent.height * samples - band * to.band_rows));
  call.filters = options.method == Method::kMap || options.method == Method::kParameters,
  call.draws = options.draws_one_basis;
  if (traits.layers) {
    render_layers(call, camera, band);
  } else {
    record_seen(band);
    record_shading(call, camera);
  }
  const std::uint32_t pixels = static_cast<std::uint32_t>(to.extent.width) * (call.rows / samples);
  commands.dispatch(resolve, to.resolve_bindings, bytes_of(call), Workgroups{(pixels + 63) / 64, 1});
}

/// Throws Error where a shader has said that it does not end.
void DeviceRenderer::Impl::check_shaders() {
  DeviceBuffer counts(*device, sizeof(UVec4));
  commands.copy(targets->lists, counts, sizeof(UVec4));
  commands.run(kTimeout);
  UVec4 values;
  std::memcpy(&values, counts.data(), sizeof values);
  if (values.w != 0)
    throw Error("shader \"{}\": {}(): expected loops that end within {} rounds in all, found more",
                names[(values.w - 1) / kStatusFunctions], status_function(values.w - 1), kMostRounds);
}

DeviceRenderer::DeviceRenderer(std::shared_ptr<Device> device, const Scene& scene, const DeviceRenderOptions& options,
                               const std::vector<ObjectData>& data) {
  require_device_method(options);
  if (scene.lights.size() > kMostLights)
    throw Error("{} lights: expected at most {} on a device", scene.lights.size(), kMostLights);
  std::vector<ObjectData> used(scene.objects.size());
  int side = side_of(options);
  for (std::size_t i = 0; i < used.size(); ++i) {
    const Object& object = scene.objects[i];
    const ObjectData found = i < data.size() ? data[i] : ObjectData{};
    if (options.method == Method::kParameters) {
      require_parameters(object, found);
      used[i] = {nullptr, found.parameters, nullptr, found.slopes};
    }
    if (options.method != Method::kMap) continue;
    require_map(object, found);
    if (found.map->verdict == MapVerdict::kDoesNotReduce)
      side = kFallbackSide;
    else
      used[i].map = found.map;
  }
  impl_ = std::make_unique<Impl>(std::move(device), scene, options, side, used);
}

DeviceRenderer::~DeviceRenderer() = default;
DeviceRenderer::DeviceRenderer(DeviceRenderer&&) noexcept = default;
DeviceRenderer& DeviceRenderer::operator=(DeviceRenderer&&) noexcept = default;

double DeviceRenderer::render(const Scene& scene, int frame) {
  Impl& impl = *impl_;
  if (scene.objects.size() != impl.objects.size() || scene.lights.size() != impl.lights)
    throw Error("device renderer: made for {} objects and {} lights, asked to render {} and {}", impl.objects.size(),
                impl.lights, scene.objects.size(), scene.lights.size());
  if (!impl.targets->fits(scene)) impl.make_targets(scene);
  const auto start = std::chrono::steady_clock::now();
  impl.record_uploads(scene, frame);
  impl.record_shadows();
  const CameraRays camera = make_camera_rays(scene.camera);
  for (int band = 0; band < impl.targets->bands; ++band) impl.render_band(camera, band);
  impl.commands.run(kTimeout);
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  impl.check_shaders();
  return seconds;
}

Image DeviceRenderer::picture() const {
  FrameTargets& from = *impl_->targets;
  impl_->commands.copy(from.picture, from.read_back, from.read_back.size());
  impl_->commands.run(kTimeout);
  Image image(from.extent.width, from.extent.height, 3);
  const std::byte* pixel = from.read_back.data();
  for (std::size_t i = 0; i < image.pixels(); ++i, pixel += sizeof(Vec4))
    std::memcpy(&image.data[3 * i], pixel, 3 * sizeof(float));
  return image;
}

}  // namespace redmap
