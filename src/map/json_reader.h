// Reading JSON that others wrote: every member is checked, and errors name the file, the key, what was expected and
// what was found. Behind map_file.h; not part of the public interface.
#pragma once

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "base/error.h"
#include "base/vec.h"

namespace redmap {

using Json = nlohmann::ordered_json;

/// Reads members of a JSON object; errors name the file, the key, what was expected and what was found.
class JsonReader {
 public:
  JsonReader(const Json& object, std::string where) : object_(object), where_(std::move(where)) {
    if (!object_.is_object()) throw Error("{}: expected a JSON object, found {}", where_, object_.type_name());
  }
  const Json& get(const char* key, const char* expected) const {
    const auto found = object_.find(key);
    if (found == object_.end()) throw Error("{}: {}: expected {}, found nothing", where_, key, expected);
    return *found;
  }
  [[noreturn]] void refuse(const char* key, const std::string& expected) const {
    throw Error("{}: {}: expected {}, found {}", where_, key, expected, get(key, "").dump().substr(0, 60));
  }
  std::string text(const char* key) const {
    const Json& value = get(key, "a text");
    if (!value.is_string()) refuse(key, "a text");
    return value.get<std::string>();
  }
  bool boolean(const char* key) const {
    const Json& value = get(key, "true or false");
    if (!value.is_boolean()) refuse(key, "true or false");
    return value.get<bool>();
  }
  double number(const char* key, double lowest, double highest) const {
    const Json& value = get(key, "a number");
    const double number = value.is_number() ? value.get<double>() : std::numeric_limits<double>::quiet_NaN();
    if (!(number >= lowest && number <= highest)) refuse(key, fmt::format("a number from {} to {}", lowest, highest));
    return number;
  }
  std::vector<float> numbers(const char* key, std::size_t fewest, std::size_t most) const {
    const Json& value = get(key, "a list of numbers");
    const std::string expected = fmt::format("{} to {} finite numbers", fewest, most);
    if (!value.is_array() || value.size() < fewest || value.size() > most) refuse(key, expected);
    std::vector<float> numbers;
    for (const Json& n : value) {
      if (!n.is_number() || !std::isfinite(n.get<float>())) refuse(key, expected);
      numbers.push_back(n.get<float>());
    }
    return numbers;
  }
  Vec3 vector(const char* key) const {
    const std::vector<float> v = numbers(key, 3, 3);
    return {v[0], v[1], v[2]};
  }
  Vec3 unit_vector(const char* key) const {
    const Vec3 v = vector(key);
    if (!(std::abs(length(v) - 1) < 1e-3f)) refuse(key, "a unit vector");
    return v;
  }

 private:
  const Json& object_;
  std::string where_;
};

}  // namespace redmap
