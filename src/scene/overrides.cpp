#include "scene/overrides.h"

#include <algorithm>
#include <array>
#include <string_view>
#include <vector>

#include "base/error.h"
#include "scene/table_reader.h"

namespace redmap {

namespace {

constexpr std::array<std::string_view, 6> kFileTables{"camera", "light", "object", "animation", "import", "background"};

/// The key of the file that `key` stands for.
std::string file_key(std::string_view key, const toml::table& scene, const std::string& source) {
  const auto dot = key.find('.');
  const std::string first(key.substr(0, dot));
  if (std::find(kFileTables.begin(), kFileTables.end(), first) != kFileTables.end()) return std::string(key);
  const toml::table* objects = scene["object"].as_table();
  if (!objects || !objects->contains(first) || dot == std::string_view::npos) {
    std::vector<std::string> candidates(kFileTables.begin(), kFileTables.end());
    if (objects)
      for (const auto& [name, node] : *objects) candidates.emplace_back(name.str());
    throw Error("{}: expected an object of the scene, camera or light before the first dot, found \"{}\"{}", source,
                first, suggestion(first, candidates));
  }
  return fmt::format("object.{}.parameters.{}", first, key.substr(dot + 1));
}

/// The text as a TOML string literal.
std::string as_text(std::string_view value) {
  std::string literal = "\"";
  for (char c : value) {
    if (c == '"' || c == '\\') literal += '\\';
    literal += c;
  }
  return literal + "\"";
}

/// The override as a table of its own.
toml::table parse_override(const std::string& text, const toml::table& scene) {
  const std::string source = "-D " + text;
  const auto equals = text.find('=');
  if (equals == std::string::npos || equals == 0)
    throw Error("{}: expected object.parameter=value, found no value", source);
  const std::string key = file_key(std::string_view(text).substr(0, equals), scene, source);
  const std::string value = text.substr(equals + 1);
  try {
    return toml::parse(key + " = " + value, source);
  } catch (const toml::parse_error&) {
    return parse_toml(key + " = " + as_text(value), source);
  }
}

void merge(toml::table& into, toml::table&& from) {
  for (auto&& [key, node] : from) {
    toml::table* below = into[key.str()].as_table();
    if (below && node.is_table())
      merge(*below, std::move(*node.as_table()));
    else
      node.visit([&](auto& value) { into.insert_or_assign(key.str(), std::move(value)); });
  }
}

}  // namespace

void apply_overrides(toml::table& scene, std::span<const std::string> overrides) {
  for (const std::string& text : overrides) merge(scene, parse_override(text, scene));
}

}  // namespace redmap
