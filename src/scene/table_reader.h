// Checked reading of TOML tables: every value that is read has the right type and lies in its range, or an Error says
// at which file, line, column and key what was expected and what was found. Internal to the scene module: the only
// header that shows toml++.
#pragma once

#include <toml++/toml.h>
#include <initializer_list>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/vec.h"

namespace redmap {

/// The open interval a number must lie in, and how to say so.
struct Bounds {
  float above = -std::numeric_limits<float>::infinity(), below = std::numeric_limits<float>::infinity();
  std::string_view expected = "a finite number";
};
inline constexpr Bounds kAnyNumber{};
inline constexpr Bounds kPositive{0, std::numeric_limits<float>::infinity(), "a number above 0"};
inline constexpr Bounds kFieldOfView{0, 180, "an angle in degrees above 0 and below 180"};

/// Parses TOML text or throws Error; `source` is what errors call it.
toml::table parse_toml(std::string_view text, const std::string& source);

/// "scene.toml:3:7", or the text of the -D option that the node came from.
std::string location(const toml::node& node);

/// `name` among `candidates`, or " (did you mean ...?)", or nothing: the end of a complaint about an unknown name.
std::string suggestion(std::string_view name, std::span<const std::string> candidates);

/// One table. Keys that are absent give the fallback where there is one. The table must outlive the reader.
class TableReader {
 public:
  /// `path` is the table's own dotted key, empty for the whole file. Throws Error if there is any key but `known`.
  TableReader(const toml::table& table, std::string path, std::initializer_list<std::string_view> known);
  /// A table whose keys are names of the user's own.
  TableReader(const toml::table& table, std::string path) : table_(table), path_(std::move(path)) {}

  bool has(std::string_view key) const { return table_.contains(key); }
  bool has_text(std::string_view key) const { return has(key) && table_.get(key)->is_string(); }
  std::vector<std::string> keys() const;
  /// Dotted, from the root of the file.
  std::string full_key(std::string_view key) const;

  float number(std::string_view key, const Bounds& bounds) const;
  float number(std::string_view key, float fallback, const Bounds& bounds) const;
  /// minimum <= value <= maximum.
  int integer(std::string_view key, std::optional<int> fallback, int minimum, int maximum) const;
  bool boolean(std::string_view key, bool fallback) const;
  std::string text(std::string_view key) const;
  /// One of `choices`.
  std::string choice(std::string_view key, std::initializer_list<std::string_view> choices) const;
  /// Three finite numbers.
  Vec3 vec3(std::string_view key) const;
  Vec3 vec3(std::string_view key, Vec3 fallback) const { return has(key) ? vec3(key) : fallback; }
  /// Three numbers from 0, or one for all of them.
  Rgb rgb(std::string_view key) const;
  Rgb rgb(std::string_view key, Rgb fallback) const { return has(key) ? rgb(key) : fallback; }
  /// One finite number or an array of them.
  std::vector<float> numbers(std::string_view key) const;
  const toml::table& table(std::string_view key) const;
  /// An array of tables; empty if absent.
  std::vector<const toml::table*> tables(std::string_view key) const;

  /// Throws Error about the value of `key`, saying what was found there.
  [[noreturn]] void fail(std::string_view key, std::string_view expected) const;
  /// Throws Error at `key`, or at the table where `key` is absent: "place: key: problem".
  [[noreturn]] void complain(std::string_view key, std::string_view problem) const;

 private:
  const toml::node& require(std::string_view key, std::string_view expected) const;
  std::optional<float> finite_number(const toml::node& node) const;

  const toml::table& table_;
  std::string path_;
};

}  // namespace redmap
