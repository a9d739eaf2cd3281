// The library's shaders by name.
#include <algorithm>
#include <map>

#include "base/error.h"
#include "base/hash.h"
#include "base/nearest.h"
#include "shader/library_entry.h"
#include "shader/parameter_values.h"
#include "shader/shader_text.h"

namespace redmap {
namespace {

const library::LibraryEntry& find_entry(std::string_view name) {
  const auto entries = library::entries();
  const auto found = std::ranges::find(entries, name, &library::LibraryEntry::name);
  if (found != entries.end()) return *found;
  throw Error("there is no library shader '{}'; did you mean '{}'?", name, nearest(name, library_shader_names()));
}

std::string read_include(std::string_view name) {
  if (const std::optional<std::string> text = library_include(name)) return *text;
  throw Error("shader include '{}' is not in the library", name);
}

std::map<std::string, ShaderInfo, std::less<>> read_infos() {
  std::map<std::string, ShaderInfo, std::less<>> infos;
  for (const library::LibraryEntry& entry : library::entries()) {
    ShaderInfo info = parse_shader_text(entry.text, std::string(entry.name) + ".glsl");
    const std::string text = library_shader_text(entry.name);
    info.text_hash = hash_bytes(0, text.data(), text.size());
    infos.emplace(entry.name, std::move(info));
  }
  return infos;
}

}  // namespace

std::vector<std::string> library_shader_names() {
  std::vector<std::string> names;
  for (const library::LibraryEntry& entry : library::entries()) names.emplace_back(entry.name);
  return names;
}

const ShaderInfo& library_shader_info(std::string_view name) {
  static const auto infos = read_infos();
  return infos.find(find_entry(name).name)->second;
}

std::shared_ptr<const Shader> make_library_shader(std::string_view name, const ParameterOverrides& overrides) {
  const library::LibraryEntry& entry = find_entry(name);
  const ShaderInfo& info = library_shader_info(name);
  return entry.make(info, parameter_values(info, overrides));
}

std::optional<std::string> library_include(std::string_view name) {
  const auto includes = library::includes();
  const auto found = std::ranges::find(includes, name, &library::LibraryInclude::name);
  return found == includes.end() ? std::nullopt : std::optional(std::string(found->text));
}

std::string library_include_text(std::string_view name) { return resolve_includes(read_include(name), read_include); }

std::vector<std::string> library_include_names() {
  std::vector<std::string> names;
  for (const library::LibraryInclude& include : library::includes()) names.emplace_back(include.name);
  return names;
}

std::string library_shader_text(std::string_view name) {
  return read_include("include/prelude.glsl") + resolve_includes(find_entry(name).text, read_include);
}

}  // namespace redmap
