// Defaults and overrides, checked against the declarations.
#include "shader/parameter_values.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "base/nearest.h"

namespace redmap {
namespace {

std::size_t find_parameter(const ShaderInfo& shader, const std::string& name) {
  const auto found = std::ranges::find(shader.parameters, name, &ParameterInfo::name);
  if (found != shader.parameters.end()) return static_cast<std::size_t>(found - shader.parameters.begin());
  std::vector<std::string> names;
  for (const ParameterInfo& parameter : shader.parameters) names.push_back(parameter.name);
  throw Error("shader '{}' has no parameter '{}'; did you mean '{}'?", shader.name, name, nearest(name, names));
}

void check_values(const ShaderInfo& shader, const ParameterInfo& parameter, const std::vector<float>& values) {
  if (values.size() != parameter.default_value.size())
    throw Error("shader '{}': parameter '{}' is a {} and takes {} number(s), found {}", shader.name, parameter.name,
                parameter.type, parameter.default_value.size(), values.size());
  for (const float value : values) {
    if (!(value >= parameter.minimum && value <= parameter.maximum))
      throw Error("shader '{}': parameter '{}' must be in [{}, {}], found {}", shader.name, parameter.name,
                  parameter.minimum, parameter.maximum, value);
    if (parameter.type == "int" && value != std::round(value))
      throw Error("shader '{}': parameter '{}' must be a whole number, found {}", shader.name, parameter.name, value);
  }
}

}  // namespace

ParameterValues parameter_values(const ShaderInfo& shader, const ParameterOverrides& overrides) {
  ParameterValues values;
  for (const ParameterInfo& parameter : shader.parameters) values.push_back(parameter.default_value);
  for (const auto& [name, override_values] : overrides) {
    const std::size_t i = find_parameter(shader, name);
    check_values(shader, shader.parameters[i], override_values);
    values[i] = override_values;
  }
  return values;
}

}  // namespace redmap
