#include "scene/map_shader.h"

#include "base/error.h"
#include "user_shader/user_shader.h"

namespace redmap {

std::shared_ptr<const Shader> shader_of(const ReductionMap& map, const std::filesystem::path& path,
                                        const std::string& device) {
  if (map.shader_origin.file.empty()) return make_library_shader(map.shader, map.parameters);
  const std::filesystem::path folder = path.parent_path();
  UserShaderSettings settings{map.parameters, {}, device};
  for (const auto& [name, image] : map.shader_origin.images)
    settings.images[name] = {folder / image.path, image.is_data};
  auto shader = make_user_shader(folder / map.shader_origin.file, map.shader, settings);
  if (shader->info().text_hash == map.shader_hash) return shader;
  throw Error("{}: expected shader \"{}\" as it was when the map was baked, found another version: bake it again",
              path.string(), map.shader);
}

void require_map_of(const Object& object, const ReductionMap& map) {
  const auto refuse = [&](const std::string& what) {
    throw Error("object '{}': its map {} was baked {}: bake it again", object.name, object.map_path.string(), what);
  };
  const ShaderInfo& shader = object.shader->info();
  if (map.surface_fingerprint != object.surface->fingerprint()) refuse("on another surface");
  if (map.shader != shader.name) refuse(fmt::format("from shader '{}', not '{}'", map.shader, shader.name));
  if (map.shader_hash != shader.text_hash) refuse(fmt::format("from another version of shader '{}'", shader.name));
  for (std::size_t i = 0; i < shader.parameters.size(); ++i) {
    const std::string& name = shader.parameters[i].name;
    const auto found = map.parameters.find(name);
    if (found == map.parameters.end() || found->second != object.shader->parameters()[i])
      refuse(fmt::format("with another value of parameter '{}'", name));
  }
}

ShaderOrigin origin_of(const ShaderInfo& shader, const std::filesystem::path& map_folder) {
  ShaderOrigin origin;
  if (shader.file.empty()) return origin;
  const auto from_map = [&](const std::filesystem::path& file) {
    // No folder is the current one.
    return std::filesystem::proximate(std::filesystem::absolute(file), std::filesystem::absolute(map_folder / "."))
        .generic_string();
  };
  origin.file = from_map(shader.file);
  for (const ShaderImageInfo& image : shader.images) origin.images[image.name] = {from_map(image.file), image.is_data};
  return origin;
}

}  // namespace redmap
