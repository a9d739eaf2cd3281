#include "web/web_scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <nlohmann/json.hpp>

#include "bake/bake.h"
#include "base/error.h"
#include "export/export.h"
#include "map/map_file.h"
#include "render/closest_view.h"
#include "scene/map_shader.h"
#include "scene/placement.h"
#include "scene/scene_file.h"

namespace redmap::cli {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

namespace {

Json json_of(Vec3 v) { return {v.x, v.y, v.z}; }
Json json_of(Rgb c) { return {c.r, c.g, c.b}; }

Json json_of(const Light& light) {
  const bool is_point = light.type == Light::Type::kPoint;
  return {{"name", light.name},
          {"type", is_point ? "point" : "directional"},
          {is_point ? "position" : "to_light", json_of(is_point ? light.position : light.to_light)},
          {"intensity", json_of(light.intensity)}};
}

Json json_of(const Camera& camera) {
  return {{"position", json_of(camera.position)},
          {"look_at", json_of(camera.look_at)},
          {"up", json_of(camera.up)},
          {"vertical_fov_degrees", camera.vertical_fov_degrees}};
}

/// Column by column.
Json matrix_of(const Transform& transform) {
  const Placement at = make_placement(transform);
  Json matrix = Json::array();
  for (const Vec3 axis : {at.rotation.x, at.rotation.y, at.rotation.z})
    for (const float value : {axis.x, axis.y, axis.z, 0.0f}) matrix.push_back(value == 0 ? value : value * at.scale);
  for (const float value : {at.translate.x, at.translate.y, at.translate.z, 1.0f}) matrix.push_back(value);
  return matrix;
}

/// A name that is part of an address as it is, and no other object's: scenes may call objects anything.
std::string folder_name(const std::string& object, std::size_t index) {
  std::string name = fmt::format("{}_{}", index, object);
  std::ranges::replace_if(
      name, [](char c) { return !std::isalnum(static_cast<unsigned char>(c)); }, '_');
  return name;
}

/// The map on disk, or one baked now where there is none of this object as it is.
std::shared_ptr<const ReductionMap> map_of(const Object& object) {
  try {
    if (fs::exists(object.map_path)) {
      ReductionMap map = read_map(object.map_path);
      require_map_of(object, map);
      return std::make_shared<const ReductionMap>(std::move(map));
    }
  } catch (const Error& error) {
    fmt::print(stderr, "{}\n", error.what());
  }
  fmt::print(stderr, "{}: baked for this view\n", object.name);
  Progress progress("bake " + object.name);
  BakeOptions options;
  options.size = object.map_size;
  options.progress = [&](float fraction, std::string_view) {
    progress.update(fraction);
    return !interrupted();
  };
  return std::make_shared<const ReductionMap>(bake(*object.surface, *object.shader, options));
}

void export_object(const Object& object, const fs::path& target) {
  ExportInput input;
  input.name = object.name;
  input.map = map_of(object);
  input.shader = object.shader, input.surface = object.surface;
  if (input.map->verdict == MapVerdict::kDoesNotReduce)
    fmt::print(stderr, "{}: its map does not stand in for its shader: {}\n", object.name, input.map->verdict_reason);
  try {
    ExportFolder folder(target);
    export_glsl(input, Compression::kGzip, folder);
    folder.commit();
  } catch (const Error& error) {
    throw Error("object '{}': {}", object.name, error.what());
  }
}

}  // namespace

void write_web_scene(const ViewOptions& options, ExportFolder& folder) {
  SceneFile file = SceneFile::load(options.scene, options.overrides, options.device);
  print_remarks(file, options.common);
  settle_map_sizes(file, [] { return interrupted(); });
  stop_if_interrupted();
  const Scene scene = file.at(1);
  const fs::path target = folder.path_of("scene");
  fs::create_directories(target);
  Json objects = Json::array(), lights = Json::array();
  for (std::size_t i = 0; i < scene.objects.size(); ++i) {
    const Object& object = scene.objects[i];
    const std::string name = folder_name(object.name, i);
    export_object(object, target / name);
    objects.push_back({{"name", object.name}, {"folder", name}, {"matrix", matrix_of(object.transform)}});
    stop_if_interrupted();
  }
  for (const Light& light : scene.lights) lights.push_back(json_of(light));
  const Json all{{"redmap_scene", 1},
                 {"name", file.path().stem().string()},
                 {"background", json_of(scene.background)},
                 {"camera", json_of(scene.camera)},
                 {"lights", lights},
                 {"objects", objects}};
  folder.add("scene/scene.json", all.dump(2) + "\n");
}

}  // namespace redmap::cli
