#include "render/renderer.h"

#include <atomic>
#include <chrono>

#include "base/error.h"
#include "base/parallel.h"
#include "base/random.h"
#include "render/filtered_shading.h"
#include "render/tile.h"

namespace redmap {

namespace {

std::unique_ptr<ObjectShading> make_shading(const Object& object, Method method, const ObjectData& data) {
  switch (method) {
    case Method::kParameters:
      return make_parameters_shading(object.shader, data.parameters);
    case Method::kPaper:
      return make_paper_shading(object.shader, data.map, data.normals);
    case Method::kMap:
      return make_map_shading(object.shader, data.map);
    case Method::kOriginal:
    case Method::kSupersample:
      break;
  }
  return make_shader_shading(object.shader);
}

void require_same_surface(const Object& object, const ReductionMap& map) {
  if (map.surface_fingerprint != object.surface->fingerprint())
    throw Error("object '{}': its map {} was baked on another surface: bake it again", object.name,
                object.map_path.string());
}

std::vector<Tile> tiles_of(const Camera& camera, int size) {
  std::vector<Tile> tiles;
  for (int y = 0; y < camera.height; y += size)
    for (int x = 0; x < camera.width; x += size)
      tiles.push_back({x, y, std::min(x + size, camera.width), std::min(y + size, camera.height)});
  return tiles;
}

}  // namespace

Renderer::Renderer(const Scene& scene, const RenderOptions& options, const std::vector<ObjectData>& data)
    : options_(options), tracer_(scene) {
  const bool uses_map = options.method == Method::kMap || options.method == Method::kPaper;
  for (std::size_t i = 0; i < scene.objects.size(); ++i) {
    const Object& object = scene.objects[i];
    bool supersampled = false;
    if (uses_map) {
      if (!data[i].map) throw Error("object '{}' has no reduction map at {}", object.name, object.map_path.string());
      require_same_surface(object, *data[i].map);
      require_same_shader(*object.shader, *data[i].map);
      supersampled = data[i].map->verdict == MapVerdict::kDoesNotReduce;
    }
    supersampled_.push_back(supersampled);
    shading_.push_back(supersampled ? make_shader_shading(object.shader)
                                    : make_shading(object, options.method, data[i]));
    transmits_ |= object.shader->info().transmits;
  }
}

RenderedFrame Renderer::render(const Scene& scene, int frame) {
  const auto start = std::chrono::steady_clock::now();
  tracer_.set_frame(scene);
  RenderedFrame result;
  result.image = Image(scene.camera.width, scene.camera.height, 3);
  if (options_.classify) result.classes.resize(static_cast<std::size_t>(scene.camera.width) * scene.camera.height);

  const FrameContext context{&scene, make_camera_rays(scene.camera), &tracer_, shading_, transmits_};
  const TileJob job{&context,
                    &options_,
                    &supersampled_,
                    scene.camera.width,
                    hash64(options_.seed, static_cast<std::uint64_t>(frame)),
                    result.image.data.data(),
                    options_.classify ? result.classes.data() : nullptr};
  const auto render_tile = options_.method == Method::kSupersample ? render_supersampled
                           : options_.method == Method::kPaper     ? render_paper
                                                                   : render_grid;
  const std::vector<Tile> tiles = tiles_of(scene.camera, tile_size(options_));
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
