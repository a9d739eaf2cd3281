// The values a shader runs with: its declared defaults, with some set by a scene or the command line.
#pragma once

#include "shader/shader.h"

namespace redmap {

/// Values in the order of `shader.parameters`. Throws Error on an unknown name (naming the nearest), a wrong number of
/// components, a value that is not finite, out of range, or not whole where the type is int.
ParameterValues parameter_values(const ShaderInfo& shader, const ParameterOverrides& overrides);

}  // namespace redmap
