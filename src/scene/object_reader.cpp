#include "scene/object_reader.h"

#include <algorithm>
#include <utility>

#include "base/error.h"
#include "shader/shader.h"
#include "user_shader/user_shader.h"

namespace redmap {

namespace {

constexpr int kMaxMapSize = 16384;  // 16 channels of it are 4 GiB

Transform read_transform(const TableReader& reader) {
  return {reader.vec3("translate", Vec3{}), reader.vec3("rotate", Vec3{}), reader.number("scale", 1, kPositive)};
}

/// What [object.NAME.parameters] sets; names are checked here, where their line is known.
ParameterOverrides read_parameters(const TableReader& object, const ShaderInfo& shader) {
  ParameterOverrides overrides;
  if (!object.has("parameters")) return overrides;
  const TableReader reader(object.table("parameters"), object.full_key("parameters"));
  std::vector<std::string> known;
  for (const ParameterInfo& parameter : shader.parameters) known.push_back(parameter.name);
  for (const std::string& key : reader.keys()) {
    if (std::find(known.begin(), known.end(), key) == known.end())
      reader.complain(key, fmt::format("expected a parameter of shader {}, found \"{}\"{}", shader.name, key,
                                       suggestion(key, known)));
    overrides[key] = reader.numbers(key);
  }
  return overrides;
}

/// What `make` returns; its Errors get the place of `key` in the scene file.
template <typename Make>
decltype(auto) at_key(const TableReader& reader, std::string_view key, Make&& make) {
  try {
    return make();
  } catch (const Error& error) {
    reader.complain(key, error.what());
  }
}

/// `wood = "wood.png"` or `bumps = { file = "bumps.png", data = true }` in [object.NAME.images].
std::map<std::string, ShaderImage> read_images(const TableReader& object, const std::filesystem::path& scene_folder) {
  std::map<std::string, ShaderImage> images;
  if (!object.has("images")) return images;
  const toml::table& table = object.table("images");
  const TableReader reader(table, object.full_key("images"));
  for (const std::string& key : reader.keys()) {
    ShaderImage image;
    if (table.get(key)->is_table()) {
      const TableReader entry(*table.get(key)->as_table(), reader.full_key(key), {"file", "data"});
      image = {scene_folder / entry.text("file"), entry.boolean("data", false)};
    } else {
      image.file = scene_folder / reader.text(key);
    }
    if (!std::filesystem::is_regular_file(image.file))
      reader.complain(key, fmt::format("expected a picture, found no file {}", image.file.lexically_normal().string()));
    images[key] = image;
  }
  return images;
}

std::shared_ptr<const Shader> read_shader_file(const TableReader& object, const std::filesystem::path& scene_folder,
                                               const std::string& device) {
  const std::string name = object.text("shader");
  const std::filesystem::path file = scene_folder / name;
  const ShaderInfo info = at_key(object, "shader", [&] { return user_shader_info(file, name); });
  const UserShaderSettings settings{read_parameters(object, info), read_images(object, scene_folder), device};
  return at_key(object, "shader", [&] { return make_user_shader(file, name, settings); });
}

std::shared_ptr<const Shader> read_shader(const TableReader& object, const std::filesystem::path& scene_folder,
                                          const std::string& device) {
  const std::string name = object.text("shader");
  if (is_shader_file(name)) return read_shader_file(object, scene_folder, device);
  if (object.has("images"))
    object.complain("images", "expected only for a shader of your own, found it for a library one");
  const ShaderInfo* info = at_key(object, "shader", [&] { return &library_shader_info(name); });
  const ParameterOverrides parameters = read_parameters(object, *info);
  return at_key(object, "parameters", [&] { return make_library_shader(name, parameters); });
}

constexpr std::string_view kMeshKeys[] = {"rest_mesh", "part", "up", "unit", "uv", "uv_set", "part_density"};
constexpr int kMaxUvSet = 15;  // more than any file was seen to have

MeshUnits read_units(const TableReader& reader) {
  MeshUnits units;
  if (reader.has("up")) units.up = reader.choice("up", {"y", "z"}) == "z" ? UpAxis::kZ : UpAxis::kY;
  if (!reader.has("unit")) return units;
  units.unit = reader.text("unit");
  at_key(reader, "unit", [&] { return metres_per(*units.unit); });
  return units;
}

UvChoice read_uv_choice(const TableReader& reader) {
  if (!reader.has("uv")) return UvChoice::kAuto;
  const std::string choice = reader.choice("uv", {"auto", "file", "unwrap"});
  return choice == "auto" ? UvChoice::kAuto : choice == "file" ? UvChoice::kFile : UvChoice::kUnwrap;
}

std::map<std::string, float> read_part_density(const TableReader& object) {
  std::map<std::string, float> densities;
  if (!object.has("part_density")) return densities;
  const TableReader reader(object.table("part_density"), object.full_key("part_density"));
  for (const std::string& name : reader.keys()) densities[name] = reader.number(name, kPositive);
  return densities;
}

void read_map_size(const TableReader& reader, Object& object) {
  object.texels_per_unit = reader.number("texels_per_unit", 0, kPositive);
  if (reader.has_text("map_size")) {
    if (reader.text("map_size") != "auto")
      reader.fail("map_size", fmt::format("a whole number from 1 to {} or \"auto\"", kMaxMapSize));
    object.map_size = kAutoMapSize;
  } else if (reader.has("map_size") && reader.has("texels_per_unit")) {
    reader.complain("texels_per_unit", "expected map_size = \"auto\" or none beside it, found a number");
  } else {
    const bool is_auto = reader.has("texels_per_unit");
    object.map_size = is_auto ? kAutoMapSize : reader.integer("map_size", object.map_size, 1, kMaxMapSize);
  }
}

}  // namespace

std::vector<LoadedMesh::Tile> ObjectReader::read_mesh_surfaces(const TableReader& reader) {
  const auto file = [&](const char* key) -> std::filesystem::path {
    if (!reader.has(key)) return {};
    const std::filesystem::path path = scene_folder_ / reader.text(key);
    if (!std::filesystem::is_regular_file(path))
      reader.complain(key, fmt::format("expected a mesh file, found no file {}", path.lexically_normal().string()));
    return path;
  };
  MeshRequest request;
  request.mesh = file("mesh"), request.rest = file("rest_mesh");
  if (reader.has("part")) request.part = reader.text("part");
  request.units = read_units(reader);
  request.uv = read_uv_choice(reader);
  request.uv_set = reader.integer("uv_set", 0, 0, kMaxUvSet);
  request.part_density = read_part_density(reader);
  MeshRequest key = request;
  key.mesh = std::filesystem::weakly_canonical(key.mesh), key.rest = std::filesystem::weakly_canonical(key.rest);
  for (const auto& [known, tiles] : meshes_)
    if (known == key) return tiles;
  LoadedMesh loaded = at_key(reader, "mesh", [&] { return load_mesh(request, scene_folder_ / "maps"); });
  for (const std::string& line : loaded.remarks) remarks_.push_back(reader.full_key("mesh") + ": " + line);
  for (const std::string& line : loaded.assumptions) assumptions_.push_back(reader.full_key("mesh") + ": " + line);
  meshes_.emplace_back(key, loaded.tiles);
  return loaded.tiles;
}

std::vector<LoadedMesh::Tile> ObjectReader::read_surfaces(const TableReader& reader) {
  if (reader.has("mesh") == reader.has("surface"))
    reader.complain("mesh", reader.has("mesh")
                                ? "expected either a mesh or a surface, found both"
                                : "expected a mesh or a surface (\"sphere\" or \"cylinder\"), found neither");
  if (reader.has("mesh")) {
    for (const char* key : {"radius", "height"})
      if (reader.has(key)) reader.complain(key, "expected only for a sphere or a cylinder, found it for a mesh");
    return read_mesh_surfaces(reader);
  }
  const bool is_sphere = reader.choice("surface", {"sphere", "cylinder"}) == "sphere";
  for (const std::string_view key : kMeshKeys)
    if (reader.has(key)) reader.complain(key, "expected only for a mesh, found it for a sphere or a cylinder");
  const float radius = reader.number("radius", 1, kPositive);
  if (is_sphere && reader.has("height"))
    reader.complain("height", "expected only for a cylinder, found it for a sphere");
  return {{0, is_sphere ? make_sphere(radius) : make_cylinder(radius, reader.number("height", 2, kPositive))}};
}

std::vector<Object> ObjectReader::read(const std::string& name, const toml::table& table) {
  const TableReader reader(
      table, "object." + name,
      {"surface", "radius",   "height",          "mesh",         "rest_mesh", "part",       "up",
       "unit",    "uv",       "uv_set",          "part_density", "shader",    "parameters", "images",
       "map",     "map_size", "texels_per_unit", "translate",    "rotate",    "scale"});
  Object object;
  object.name = object.declared_name = name;
  object.transform = read_transform(reader);
  read_map_size(reader, object);
  object.map_path = scene_folder_ / (reader.has("map") ? reader.text("map") : "maps/" + name + ".exr");
  object.shader = read_shader(reader, scene_folder_, device_);
  std::vector<Object> objects;
  for (const LoadedMesh::Tile& tile : read_surfaces(reader)) {
    objects.push_back(object);
    objects.back().surface = tile.surface;
    if (tile.number == 0) continue;
    // NAME.1001, and its map with the number before the extension.
    objects.back().name = fmt::format("{}.{}", name, tile.number);
    objects.back().map_path.replace_extension(fmt::format(".{}{}", tile.number, object.map_path.extension().string()));
  }
  return objects;
}

}  // namespace redmap
