#include "scene/object_reader.h"

#include <algorithm>
#include <utility>

#include "base/error.h"
#include "shader/shader.h"
#include "surface/atlas.h"
#include "surface/mesh.h"

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

std::shared_ptr<const Shader> read_shader(const TableReader& object) {
  const std::string name = object.text("shader");
  const ShaderInfo* info = at_key(object, "shader", [&] { return &library_shader_info(name); });
  const ParameterOverrides parameters = read_parameters(object, *info);
  return at_key(object, "parameters", [&] { return make_library_shader(name, parameters); });
}

}  // namespace

std::shared_ptr<const Surface> ObjectReader::load_mesh(const TableReader& reader) {
  const std::filesystem::path path = scene_folder_ / reader.text("mesh");
  if (!std::filesystem::is_regular_file(path))
    reader.complain("mesh", fmt::format("expected a mesh file, found no file {}", path.lexically_normal().string()));
  auto& surface = meshes_[std::filesystem::weakly_canonical(path)];
  if (surface) return surface;
  return surface = at_key(reader, "mesh", [&] {
           TriangleMesh mesh = read_mesh(path);
           if (mesh.uv_triangles.empty()) unwrap_cached(mesh, scene_folder_ / "maps");
           return make_mesh_surface(std::move(mesh));
         });
}

std::shared_ptr<const Surface> ObjectReader::read_surface(const TableReader& reader) {
  if (reader.has("mesh") == reader.has("surface"))
    reader.complain("mesh", reader.has("mesh")
                                ? "expected either a mesh or a surface, found both"
                                : "expected a mesh or a surface (\"sphere\" or \"cylinder\"), found neither");
  if (reader.has("mesh")) {
    for (const char* key : {"radius", "height"})
      if (reader.has(key)) reader.complain(key, "expected only for a sphere or a cylinder, found it for a mesh");
    return load_mesh(reader);
  }
  const bool is_sphere = reader.choice("surface", {"sphere", "cylinder"}) == "sphere";
  const float radius = reader.number("radius", 1, kPositive);
  if (is_sphere && reader.has("height"))
    reader.complain("height", "expected only for a cylinder, found it for a sphere");
  return is_sphere ? make_sphere(radius) : make_cylinder(radius, reader.number("height", 2, kPositive));
}

Object ObjectReader::read(const std::string& name, const toml::table& table) {
  const TableReader reader(table, "object." + name,
                           {"surface", "radius", "height", "mesh", "shader", "parameters", "map", "map_size",
                            "translate", "rotate", "scale"});
  Object object;
  object.name = name;
  object.transform = read_transform(reader);
  object.map_size = reader.integer("map_size", 1024, 1, kMaxMapSize);
  object.map_path = scene_folder_ / (reader.has("map") ? reader.text("map") : "maps/" + name + ".exr");
  object.shader = read_shader(reader);
  object.surface = read_surface(reader);
  return object;
}

}  // namespace redmap
