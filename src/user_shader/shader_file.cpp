#include "user_shader/shader_file.h"

#include <fmt/ranges.h>

#include "base/atomic_file.h"
#include "base/error.h"
#include "base/nearest.h"
#include "user_shader/materialx.h"
#include "user_shader/plugin_shader.h"

namespace redmap {
namespace {

ShaderSource read_include(const std::string& name, const std::string& includer, const std::string& where) {
  const std::filesystem::path beside = (std::filesystem::path(includer).parent_path() / name).lexically_normal();
  if (std::filesystem::is_regular_file(beside)) return {beside.string(), read_file(beside)};
  if (std::optional<std::string> text = library_include(name)) return {name, *text};
  throw Error("{}: include \"{}\": expected a file beside this one, or one of {}; found neither", where, name,
              fmt::join(library_include_names(), ", "));
}

}  // namespace

ShaderSources read_shader_sources(const std::filesystem::path& file) {
  if (!std::filesystem::is_regular_file(materialx_document(file)))
    throw Error("{}: expected a shader file, found none", file.lexically_normal().string());
  const std::string name = file.lexically_normal().string();
  if (is_materialx(file)) return resolve_sources({name + ", as GLSL", translate_materialx(file).text}, read_include);
  return resolve_sources({name, read_file(file)}, read_include);
}

bool is_plugin(const std::filesystem::path& file) { return file.extension() == ".so"; }

bool is_shader_file(const std::string& shader) {
  return shader.ends_with(".glsl") || is_plugin(shader) || is_materialx(shader);
}

ShaderInfo user_shader_info(const std::filesystem::path& file, const std::string& name) {
  if (is_plugin(file)) return plugin_info(file, name);
  const ShaderSources sources = read_shader_sources(file);
  require_own_world(sources.text, sources.names);
  ShaderInfo info = parse_shader_text(sources.text, sources.names);
  info.name = name;
  info.file = file;
  return info;
}

}  // namespace redmap
