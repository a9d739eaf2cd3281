// A user's GLSL file with all it includes. Not part of the public interface.
#pragma once

#include <filesystem>

#include "shader/shader_text.h"

namespace redmap {

/// Whether `file` is a plug-in (plugin.h) and not a text.
bool is_plugin(const std::filesystem::path& file);

/// `file` and the files it includes: those beside the file that includes them, else the library's. Throws Error.
ShaderSources read_shader_sources(const std::filesystem::path& file);

}  // namespace redmap
