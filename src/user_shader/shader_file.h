// A user's GLSL file with all it includes. Not part of the public interface.
#pragma once

#include <filesystem>

#include "shader/shader_text.h"

namespace redmap {

/// `file` and the files it includes: those beside the file that includes them, else the library's. Throws Error.
ShaderSources read_shader_sources(const std::filesystem::path& file);

}  // namespace redmap
