#include "scene/table_reader.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "base/nearest.h"

namespace redmap {

namespace {

/// What a person would call the node: its value if it is short, else its kind.
std::string describe(const toml::node& node) {
  if (const auto* text = node.as_string()) return fmt::format("\"{}\"", text->get());
  if (const auto* integer = node.as_integer()) return fmt::format("{}", integer->get());
  if (const auto* number = node.as_floating_point()) return fmt::format("{}", number->get());
  if (const auto* boolean = node.as_boolean()) return boolean->get() ? "true" : "false";
  if (node.is_table()) return "a table";
  if (const auto* array = node.as_array()) {
    std::string items;
    for (const toml::node& item : *array) items += (items.empty() ? "" : ", ") + describe(item);
    return "[" + items + "]";
  }
  return "a date or time";
}

std::string quoted_list(std::span<const std::string> names) {
  std::string list;
  for (const std::string& name : names) list += (list.empty() ? "" : ", ") + name;
  return list;
}

/// Names and values of the file may hold line breaks; complaints must not.
[[noreturn]] void refuse(std::string message) {
  std::replace_if(
      message.begin(), message.end(), [](unsigned char c) { return c < ' ' || c == 0x7f; }, ' ');
  throw Error(message);
}

}  // namespace

toml::table parse_toml(std::string_view text, const std::string& source) {
  try {
    return toml::parse(text, source);
  } catch (const toml::parse_error& error) {
    const auto& begin = error.source().begin;
    refuse(fmt::format("{}:{}:{}: this is no TOML: {}", source, begin.line, begin.column, error.description()));
  }
}

std::string location(const toml::node& node) {
  const toml::source_region& source = node.source();
  const std::string path = source.path ? *source.path : "scene";
  if (path.starts_with("-D ")) return path;
  return fmt::format("{}:{}:{}", path, source.begin.line, source.begin.column);
}

std::string suggestion(std::string_view name, std::span<const std::string> candidates) {
  const std::string best = nearest(name, candidates);
  return best.empty() ? "" : fmt::format(" (did you mean \"{}\"?)", best);
}

TableReader::TableReader(const toml::table& table, std::string path, std::initializer_list<std::string_view> known)
    : table_(table), path_(std::move(path)) {
  const std::vector<std::string> names(known.begin(), known.end());
  for (const auto& [key, node] : table) {
    if (std::find(known.begin(), known.end(), key.str()) != known.end()) continue;
    refuse(fmt::format("{}: {}: unknown key{}, expected one of {}", location(node), full_key(key.str()),
                       suggestion(key.str(), names), quoted_list(names)));
  }
}

std::vector<std::string> TableReader::keys() const {
  std::vector<std::string> keys;
  for (const auto& [key, node] : table_) keys.emplace_back(key.str());
  return keys;
}

std::string TableReader::full_key(std::string_view key) const {
  return path_.empty() ? std::string(key) : fmt::format("{}.{}", path_, key);
}

void TableReader::complain(std::string_view key, std::string_view problem) const {
  const toml::node* node = table_.get(key);
  refuse(fmt::format("{}: {}: {}", location(node ? *node : table_), full_key(key), problem));
}

void TableReader::fail(std::string_view key, std::string_view expected) const {
  const toml::node* node = table_.get(key);
  complain(key, fmt::format("expected {}, found {}", expected, node ? describe(*node) : "nothing"));
}

const toml::node& TableReader::require(std::string_view key, std::string_view expected) const {
  const toml::node* node = table_.get(key);
  if (!node) fail(key, expected);
  return *node;
}

std::optional<float> TableReader::finite_number(const toml::node& node) const {
  if (!node.is_number()) return std::nullopt;
  const auto value = static_cast<float>(node.value<double>().value());
  return std::isfinite(value) ? std::optional(value) : std::nullopt;
}

float TableReader::number(std::string_view key, const Bounds& bounds) const {
  const auto value = finite_number(require(key, bounds.expected));
  if (!value || !(*value > bounds.above) || !(*value < bounds.below)) fail(key, bounds.expected);
  return *value;
}

float TableReader::number(std::string_view key, float fallback, const Bounds& bounds) const {
  return has(key) ? number(key, bounds) : fallback;
}

int TableReader::integer(std::string_view key, std::optional<int> fallback, int minimum, int maximum) const {
  if (!has(key) && fallback) return *fallback;
  const std::string expected = fmt::format("a whole number from {} to {}", minimum, maximum);
  const auto* value = require(key, expected).as_integer();
  if (!value || value->get() < minimum || value->get() > maximum) fail(key, expected);
  return static_cast<int>(value->get());
}

bool TableReader::boolean(std::string_view key, bool fallback) const {
  if (!has(key)) return fallback;
  const auto* value = table_.get(key)->as_boolean();
  if (!value) fail(key, "true or false");
  return value->get();
}

std::string TableReader::text(std::string_view key) const {
  const auto* value = require(key, "text in quotes").as_string();
  if (!value || value->get().empty()) fail(key, "text in quotes");
  return value->get();
}

std::string TableReader::choice(std::string_view key, std::initializer_list<std::string_view> choices) const {
  std::string expected;
  for (std::string_view item : choices) expected += fmt::format("{}\"{}\"", expected.empty() ? "" : " or ", item);
  const auto* value = require(key, expected).as_string();
  if (!value || std::find(choices.begin(), choices.end(), value->get()) == choices.end()) fail(key, expected);
  return value->get();
}

std::vector<float> TableReader::numbers(std::string_view key) const {
  constexpr std::string_view kExpected = "a finite number or an array of them";
  const toml::node& node = require(key, kExpected);
  std::vector<float> values;
  const auto append = [&](const toml::node& item) {
    const auto value = finite_number(item);
    if (!value) fail(key, kExpected);
    values.push_back(*value);
  };
  if (const auto* array = node.as_array())
    for (const toml::node& item : *array) append(item);
  else
    append(node);
  return values;
}

Vec3 TableReader::vec3(std::string_view key) const {
  constexpr std::string_view kExpected = "three finite numbers [x, y, z]";
  const auto* array = require(key, kExpected).as_array();
  if (!array || array->size() != 3) fail(key, kExpected);
  Vec3 value;
  for (int i = 0; i < 3; ++i) {
    const auto component = finite_number((*array)[static_cast<std::size_t>(i)]);
    if (!component) fail(key, kExpected);
    value[i] = *component;
  }
  return value;
}

Rgb TableReader::rgb(std::string_view key) const {
  constexpr std::string_view kExpected = "[r, g, b] or one number, finite and not below 0";
  const toml::node& node = require(key, kExpected);
  if (!node.is_number() && !node.is_array()) fail(key, kExpected);
  const std::vector<float> values = numbers(key);
  if (values.size() != (node.is_array() ? 3u : 1u)) fail(key, kExpected);
  if (std::any_of(values.begin(), values.end(), [](float value) { return value < 0; })) fail(key, kExpected);
  return {values.front(), values[values.size() / 2], values.back()};
}

const toml::table& TableReader::table(std::string_view key) const {
  const auto* value = require(key, "a table").as_table();
  if (!value) fail(key, "a table");
  return *value;
}

std::vector<const toml::table*> TableReader::tables(std::string_view key) const {
  std::vector<const toml::table*> tables;
  if (!has(key)) return tables;
  const auto* array = table_.get(key)->as_array();
  if (!array) fail(key, "an array of tables");
  for (const toml::node& item : *array) {
    if (!item.is_table()) fail(key, "an array of tables");
    tables.push_back(item.as_table());
  }
  return tables;
}

}  // namespace redmap
