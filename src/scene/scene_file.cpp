#include "scene/scene_file.h"

#include <cmath>
#include <optional>
#include <vector>

#include "base/atomic_file.h"
#include "base/error.h"
#include "scene/animation_reader.h"
#include "scene/gltf_import.h"
#include "scene/object_reader.h"
#include "scene/overrides.h"
#include "scene/table_reader.h"

namespace redmap {

namespace {

constexpr int kMaxPictureSize = 16384;   // pixels along one side
constexpr float kSmallestAngle = 1e-4f;  // radians between view and up below which the frame is numerical noise

std::string read_text(const std::filesystem::path& path) {
  if (!std::filesystem::exists(path)) throw Error("{}: expected a scene file, found no such file", path.string());
  if (std::filesystem::is_directory(path)) throw Error("{}: expected a scene file, found a folder", path.string());
  return read_file(path);
}

/// `imported` stands in for whatever the table does not say.
Camera read_camera(const toml::table& table, const std::optional<Camera>& imported) {
  const TableReader reader(table, "camera", {"position", "look_at", "up", "fov", "width", "height"});
  Camera camera = imported.value_or(Camera());
  camera.position = imported ? reader.vec3("position", camera.position) : reader.vec3("position");
  camera.look_at = reader.vec3("look_at", camera.look_at);
  camera.up = reader.vec3("up", camera.up);
  camera.vertical_fov_degrees = reader.number("fov", camera.vertical_fov_degrees, kFieldOfView);
  camera.width = reader.integer("width", camera.width, 1, kMaxPictureSize);
  camera.height = reader.integer("height", camera.height, 1, kMaxPictureSize);
  return camera;
}

Light read_light(const std::string& name, const toml::table& table) {
  const TableReader reader(table, "light." + name, {"type", "position", "to_light", "intensity", "shadows"});
  Light light;
  light.name = name;
  const bool is_point = reader.choice("type", {"point", "directional"}) == "point";
  light.type = is_point ? Light::Type::kPoint : Light::Type::kDirectional;
  const char* superfluous = is_point ? "to_light" : "position";
  if (reader.has(superfluous))
    reader.complain(superfluous, is_point ? "expected only for a directional light, found it for a point light"
                                          : "expected only for a point light, found it for a directional light");
  (is_point ? light.position : light.to_light) = reader.vec3(is_point ? "position" : "to_light");
  light.intensity = reader.rgb("intensity", light.intensity);
  light.shadows = reader.boolean("shadows", true);
  return light;
}

/// What [import] brings.
GltfImport read_import(const TableReader& file, const std::filesystem::path& scene_folder) {
  if (!file.has("import")) return {};
  const TableReader reader(file.table("import"), "import", {"gltf"});
  const std::filesystem::path path = scene_folder / reader.text("gltf");
  if (!std::filesystem::is_regular_file(path))
    reader.complain("gltf", fmt::format("expected a glTF file, found no file {}", path.lexically_normal().string()));
  try {
    return import_gltf(path);
  } catch (const Error& error) {
    reader.complain("gltf", error.what());
  }
}

/// The lights of the file, and before them the imported ones that it does not redefine.
std::vector<Light> read_lights(const TableReader& file, const std::vector<Light>& imported) {
  static const toml::table kNoLights;
  const TableReader reader(file.has("light") ? file.table("light") : kNoLights, "light");
  std::vector<Light> lights;
  for (const Light& light : imported)
    if (!reader.has(light.name)) lights.push_back(light);
  for (const std::string& name : reader.keys()) lights.push_back(read_light(name, reader.table(name)));
  return lights;
}

Scene read_scene(const toml::table& file, const std::filesystem::path& path, const std::string& device,
                 std::vector<std::string>& remarks, std::vector<std::string>& assumptions) {
  const TableReader reader(file, "", {"background", "import", "camera", "light", "object", "animation"});
  const GltfImport import = read_import(reader, path.parent_path());
  if (!reader.has("camera") && !import.camera) throw Error("{}: expected a [camera] table, found none", path.string());
  Scene scene;
  scene.background = reader.rgb("background", scene.background);
  scene.camera = reader.has("camera") ? read_camera(reader.table("camera"), import.camera) : *import.camera;
  scene.lights = read_lights(reader, import.lights);
  if (reader.has("object")) {
    ObjectReader object_reader(path.parent_path(), device);
    const TableReader objects(reader.table("object"), "object");
    for (const std::string& name : objects.keys())
      for (Object& object : object_reader.read(name, objects.table(name))) scene.objects.push_back(std::move(object));
    remarks = object_reader.remarks(), assumptions = object_reader.assumptions();
  }
  return scene;
}

/// What only the values together can tell. Throws Error.
void check_moment(const Scene& scene, const std::filesystem::path& path, int frame) {
  const Camera& camera = scene.camera;
  const Vec3 view = camera.look_at - camera.position;
  if (!(length(view) > 0) || !std::isfinite(length(view)))
    throw Error("{}: camera at frame {}: expected look_at away from position, found both at [{}, {}, {}]",
                path.string(), frame, camera.position.x, camera.position.y, camera.position.z);
  if (!(length(cross(normalized(view), normalized(camera.up))) > kSmallestAngle))
    throw Error("{}: camera at frame {}: expected up across the viewing direction, found [{}, {}, {}] along it",
                path.string(), frame, camera.up.x, camera.up.y, camera.up.z);
  for (const Light& light : scene.lights)
    if (light.type == Light::Type::kDirectional && !(length(light.to_light) > 0))
      throw Error("{}: light.{}.to_light at frame {}: expected a direction, found the zero vector", path.string(),
                  light.name, frame);
}

}  // namespace

SceneFile SceneFile::load(const std::filesystem::path& path, std::span<const std::string> overrides,
                          const std::string& device) {
  toml::table file = parse_toml(read_text(path), path.string());
  apply_overrides(file, overrides);
  SceneFile scene;
  scene.path_ = path;
  scene.rest_ = read_scene(file, path, device, scene.remarks_, scene.assumptions_);
  if (file.contains("animation"))
    scene.animation_ = read_animation(TableReader(file, "").table("animation"), scene.rest_);
  for (int frame = 1; frame <= scene.frame_count(); ++frame)
    check_moment(animate(scene.rest_, scene.animation_, frame), path, frame);
  return scene;
}

Scene SceneFile::at(int frame) const {
  if (frame < 1 || frame > frame_count())
    throw Error("{}: expected a frame from 1 to {}, found {}", path_.string(), frame_count(), frame);
  return animate(rest_, animation_, frame);
}

std::vector<Object> SceneFile::objects(const std::string& name) const {
  std::vector<Object> objects;
  std::vector<std::string> names;
  for (const Object& object : rest_.objects) {
    if (object.name == name || object.declared_name == name) objects.push_back(object);
    names.push_back(object.name);
  }
  if (!objects.empty()) return objects;
  throw Error("{}: expected an object of the scene, found \"{}\"{}", path_.string(), name, suggestion(name, names));
}

}  // namespace redmap
