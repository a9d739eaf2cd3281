// What a shader's text declares, read without compiling it: parameters and functions (docs/shaders.md).
#pragma once

#include <functional>
#include <string>
#include <string_view>

#include "shader/shader.h"

namespace redmap {

/// Reads the declarations of a shader text: the first comment line, `struct Parameters` with one comment a member, and
/// which functions exist. The shader's name is `file_name` without folder and extension.
/// Throws Error with `file_name:line` on a malformed declaration or when the required functions are missing.
ShaderInfo parse_shader_text(std::string_view text, std::string_view file_name);

/// `text` with every `#include "NAME"` line replaced by `read(NAME)`, and so on inside that. An include that leads
/// back to itself throws Error; a file that is included twice must guard itself.
std::string resolve_includes(std::string_view text, const std::function<std::string(std::string_view name)>& read);

/// The complete text of a library shader, includes resolved, ready for a GLSL compiler behind a version line and
/// precision statements. Throws Error naming the nearest library shader if there is none of that name.
std::string library_shader_text(std::string_view name);

}  // namespace redmap
