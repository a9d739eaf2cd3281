// What a shader's text declares, read without compiling it: parameters and functions (docs/shaders.md).
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "shader/shader.h"

namespace redmap {

/// Reads the declarations of a shader text: the first comment line, `struct Parameters` with one comment a member, and
/// which functions exist. The shader's name is `file_name` without folder and extension.
/// Throws Error with `file_name:line` on a malformed declaration or when the required functions are missing.
ShaderInfo parse_shader_text(std::string_view text, std::string_view file_name);
/// The same for a text put together from several files (see ShaderSources).
ShaderInfo parse_shader_text(std::string_view text, std::span<const std::string> source_names);

/// Only the first comment line and `struct Parameters`, of a text that has no functions.
ShaderInfo parse_declaration(std::string_view text, const std::string& source_name);

/// `text` with every `#include "NAME"` line replaced by `read(NAME)`, and so on inside that. An include that leads
/// back to itself throws Error; a file that is included twice must guard itself.
std::string resolve_includes(std::string_view text, const std::function<std::string(std::string_view name)>& read);

/// A file of a shader's text.
struct ShaderSource {
  std::string name;  ///< as errors call it
  std::string text;
};

/// A text put together from files, without its `#version`; a line `#line N I` says that line N of names[I] follows.
struct ShaderSources {
  std::string text;
  std::vector<std::string> names;
};

/// What `#include "NAME"` means in the file `includer`; `where` is its place, for errors.
using ReadSource =
    std::function<ShaderSource(const std::string& name, const std::string& includer, const std::string& where)>;

/// `main` and all it includes. An include that leads back to itself throws Error.
ShaderSources resolve_sources(const ShaderSource& main, const ReadSource& read);

/// Throws Error "NAME:LINE:COLUMN: ..." where a text reaches for more than a shader is given: buffers, other uniforms
/// than images, built-in variables of a stage.
void require_own_world(std::string_view text, std::span<const std::string> source_names);

/// A file that texts can include, such as "include/noise.glsl"; nothing if the library has none of that name.
std::optional<std::string> library_include(std::string_view name);
/// The same with what it includes itself. Throws Error if there is none of that name.
std::string library_include_text(std::string_view name);
/// The names of all.
std::vector<std::string> library_include_names();

/// The complete text of a library shader, includes resolved, ready for a GLSL compiler behind a version line and
/// precision statements. Throws Error naming the nearest library shader if there is none of that name.
std::string library_shader_text(std::string_view name);

}  // namespace redmap
