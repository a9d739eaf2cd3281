// A shader's parameters, declared once, in its text: name, type, default, range, unit, meaning.
#pragma once

#include <map>
#include <string>
#include <vector>

namespace redmap {

/// Declared as `float scale;  // 14 [0.1, 1000] 1/unit: cells per object unit`.
struct ParameterInfo {
  std::string name;
  std::string type;  ///< float, int, vec2 or vec3
  std::vector<float> default_value;
  float minimum, maximum;  ///< of every component
  std::string unit;        ///< empty for pure numbers
  std::string meaning;
};

/// One value (1 to 3 components) a parameter.
using ParameterValues = std::vector<std::vector<float>>;
/// What a scene or the command line sets, by name.
using ParameterOverrides = std::map<std::string, std::vector<float>>;

}  // namespace redmap
