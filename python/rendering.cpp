// From a scene and its maps to pictures.
#include "render/renderer.h"

#include "arrays.h"
#include "interruptible.h"
#include "map/map_file.h"

namespace redmap::python {
namespace {

using Maps = std::vector<std::shared_ptr<const ReductionMap>>;

Method method_of(const std::string& name) {
  for (const Method method : {Method::kMap, Method::kOriginal, Method::kSupersample})
    if (kMethodNames[static_cast<std::size_t>(method)] == name) return method;
  throw Error("method: expected \"map\", \"original\" or \"supersample\", found \"{}\"", name);
}

/// One map an object: those given, or else the files that the objects name.
std::vector<ObjectData> data_of(const Scene& scene, Method method, const std::optional<Maps>& maps) {
  std::vector<ObjectData> data(scene.objects.size());
  if (method != Method::kMap) return data;
  if (maps && maps->size() != data.size())
    throw Error("maps: expected one for each of {} objects, found {}", data.size(), maps->size());
  for (std::size_t i = 0; i < data.size(); ++i)
    data[i].map = maps ? (*maps)[i] : std::make_shared<const ReductionMap>(read_map(scene.objects[i].map_path));
  return data;
}

ImageOut render(const PythonScene& python_scene, const std::optional<Maps>& maps, const std::string& method,
                const std::string& quality, int spp, std::uint64_t seed, int frame, const Progress& progress) {
  RenderOptions options;
  options.method = method_of(method), options.quality = quality_of(quality), options.spp = spp, options.seed = seed;
  const Scene scene = scene_of(python_scene);
  Image image;
  run_interruptibly(
      [&](Work& work) {
        options.progress = [&](double part) { work.tell(part); };
        options.cancelled = [&] { return work.stopped(); };
        image = Renderer(scene, options, data_of(scene, options.method, maps)).render(scene, frame).image;
      },
      progress);
  return array_of(std::move(image));
}

}  // namespace

void bind_rendering(nb::module_& module) {
  module.def(
      "render", &render, "scene"_a, "maps"_a = nb::none(), nb::kw_only(), "method"_a = "map", "quality"_a = "default",
      "spp"_a = 0, "seed"_a = 0, "frame"_a = 1, "progress"_a = nb::none(),
      fmt::format("A picture of the scene, (height, width, 3) in linear light. `maps`: one an object; without, the "
                  "files that the objects name are read. method: map, original (the shader itself, at the map's "
                  "rays) or supersample. quality: default (2 x 2 rays a pixel), balanced (one, more on bends and "
                  "highlights) or "
                  "fast (one). spp: {}. frame: "
                  "decides the random numbers. progress: told the part done. Raises Error.",
                  doc::RenderOptions_spp)
          .c_str());
}

}  // namespace redmap::python
