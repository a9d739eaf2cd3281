// GLSL 4.50 to SPIR-V, by glslang, for compute on Vulkan 1.1 devices.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace redmap {

/// Compiles a complete compute shader. A line `#line N I` in `text` says that line N of source I follows;
/// `source_names[I]` is what errors call it. Indices into arrays are clamped to their bounds. Throws Error
/// "NAME:LINE:COLUMN: what is wrong" for the first mistake.
std::vector<std::uint32_t> compile_glsl(const std::string& text, std::span<const std::string> source_names);

}  // namespace redmap
