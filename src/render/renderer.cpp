#include "render/renderer.h"

#include <atomic>
#include <chrono>

#include "base/error.h"
#include "base/parallel.h"
#include "base/random.h"
#include "render/tile.h"
#include "scene/object_data.h"

namespace redmap {

namespace {

std::unique_ptr<ObjectShading> make_shading(const Object& object, Method method, const ObjectData& data) {
  switch (method) {
    case Method::kParameters:
      return make_parameters_shading(object.shader, data.parameters, data.slopes);
    case Method::kPaper:
      return make_paper_shading(object.shader, data.map, data.normals);
    case Method::kMap:
      return make_map_shading(object.shader, data.map, object.surface);
    case Method::kOriginal:
    case Method::kSupersample:
      break;
  }
  return make_shader_shading(object.shader);
}

bool uses_map(Method method) { return method == Method::kMap || method == Method::kPaper; }

/// Throws Error if something that the method needs is missing.
void require_data(const Object& object, Method method, const ObjectData& data) {
  if (uses_map(method)) require_map(object, data);
  if (method == Method::kPaper && !data.normals) throw Error("object '{}' has no mean normals", object.name);
  if (method == Method::kParameters) require_parameters(object, data);
}

/// What 0 samples stand for, and what is too many.
RenderOptions checked(RenderOptions options) {
  constexpr int kMostSamples = 1 << 20, kMostGridSamples = 256;
  if (options.method == Method::kSupersample && options.spp == 0) options.spp = 16;  // what the paper compares with
  if (options.spp < 0 || options.spp > kMostSamples)
    throw Error("{} samples a pixel: expected 1 to {}", options.spp, kMostSamples);
  const Strata strata = strata_of(std::max(options.spp, 1));
  if (options.method == Method::kOriginal && (strata.columns != strata.rows || options.spp > kMostGridSamples))
    throw Error("{} samples a pixel for original: expected a square number up to {}", options.spp, kMostGridSamples);
  return options;
}

std::vector<Tile> tiles_of(const Camera& camera, int size) {
  std::vector<Tile> tiles;
  for (int y = 0; y < camera.height; y += size)
    for (int x = 0; x < camera.width; x += size)
      tiles.push_back({x, y, std::min(x + size, camera.width), std::min(y + size, camera.height)});
  return tiles;
}

}  // namespace

bool is_supersampled(const Object& object, Method method, const ObjectData& data) {
  if (!uses_map(method) || data.map->verdict != MapVerdict::kDoesNotReduce) return false;
  const ShaderInfo& shader = object.shader->info();
  const bool for_normals_alone =
      shader.perturbs_normals && !shader.varies_in_time && data.map->residual <= data.map->tolerance;
  return method != Method::kPaper || !for_normals_alone;
}

Renderer::Renderer(const Scene& scene, const RenderOptions& options, const std::vector<ObjectData>& data)
    : options_(checked(options)), tracer_(scene) {
  if (data.size() != scene.objects.size())
    throw Error("renderer: {} objects, but data for {}", scene.objects.size(), data.size());
  for (std::size_t i = 0; i < scene.objects.size(); ++i) {
    const Object& object = scene.objects[i];
    require_data(object, options_.method, data[i]);
    const bool stands_in = static_cast<bool>(options_.stand_in);
    const bool supersampled = !stands_in && is_supersampled(object, options_.method, data[i]);
    supersampled_.push_back(supersampled);
    originals_.push_back(make_shader_shading(object.shader));
    shading_.push_back(stands_in      ? options_.stand_in(object)
                       : supersampled ? make_shader_shading(object.shader)
                                      : make_shading(object, options_.method, data[i]));
    transmits_ |= object.shader->info().transmits;
  }
}

RenderedFrame Renderer::render(const Scene& scene, int frame) {
  const auto start = std::chrono::steady_clock::now();
  if (scene.objects.size() != shading_.size())
    throw Error("renderer: made for {} objects, asked to render {}", shading_.size(), scene.objects.size());
  tracer_.set_frame(scene);
  RenderedFrame result;
  result.image = Image(scene.camera.width, scene.camera.height, 3);
  if (options_.classify) result.classes.resize(static_cast<std::size_t>(scene.camera.width) * scene.camera.height);

  if (options_.decisions) result.decisions.resize(result.image.pixels());

  FrameContext context{&scene, make_camera_rays(scene.camera), &tracer_, shading_, originals_, transmits_};
  set_quality(options_, context);
  const TileJob job{&context,
                    &options_,
                    &supersampled_,
                    scene.camera.width,
                    hash64(options_.seed, static_cast<std::uint64_t>(frame)),
                    {result.image.data.data(), options_.decisions ? result.decisions.data() : nullptr},
                    options_.classify ? result.classes.data() : nullptr};
  const auto render_tile = options_.method == Method::kSupersample ? render_supersampled
                           : options_.method == Method::kPaper     ? render_paper
                                                                   : render_grid;
  const std::vector<Tile> tiles = tiles_of(scene.camera, tile_size(options_, scene.camera.width, scene.camera.height));
  std::vector<RenderCounts> counts(tiles.size());
  std::atomic<std::size_t> done = 0;
  parallel_for(tiles.size(), [&](std::size_t i) {
    if (options_.cancelled && options_.cancelled()) return;
    counts[i] = render_tile(job, tiles[i]);
    if (options_.progress) options_.progress(static_cast<double>(++done) / static_cast<double>(tiles.size()));
  });
  for (const RenderCounts& tile : counts) result.counts += tile;
  result.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return result;
}

}  // namespace redmap
