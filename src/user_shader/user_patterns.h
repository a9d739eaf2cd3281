// Patterns of a user's shader: bytes that only the shader understands. Not part of the public interface.
#pragma once

#include <memory>

#include "shader/shader.h"
#include "user_shader/program.h"

namespace redmap {

/// What a shader's patterns share.
struct UserShaderParts {
  ShaderInfo info;
  ParameterValues values;
  ShaderProgram program;
};

/// The patterns of `shader` at `points`. Throws Error, now and later, where a function does not end or returns
/// nonsense.
std::unique_ptr<BoundPatterns> bind_user_patterns(std::shared_ptr<const UserShaderParts> shader,
                                                  const SurfacePoints& points);

}  // namespace redmap
