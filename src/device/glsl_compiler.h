// GLSL 4.50 to SPIR-V, by glslang, for Vulkan 1.1 devices.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace redmap {

/// Compiles a complete compute shader. A line `#line N I` in `text` says that line N of source I follows;
/// `source_names[I]` is what errors call it. Indices into arrays are clamped to their bounds. `loop_guard`, if given,
/// names a function `bool NAME()` of the text that every loop asks before each round, and that ends it by saying false.
/// Throws Error "NAME:LINE:COLUMN: what is wrong" for the first mistake, and "NAME: what is wrong" for what would be
/// too much for a device (spirv_checks.h).
std::vector<std::uint32_t> compile_glsl(const std::string& text, std::span<const std::string> source_names,
                                        const std::string& loop_guard = "");

enum class GlslStage { kCompute, kVertex, kFragment };
/// The same for a text of redmap's own, which is compiled as it is: no index is clamped, nothing is checked for being
/// too much. `name` is what errors call it.
std::vector<std::uint32_t> compile_own_glsl(const std::string& text, const std::string& name, GlslStage stage);

/// Bytes from one element to the next of the array that is the only member of the buffer block `name`. Throws Error
/// where there is none.
std::size_t array_stride(std::span<const std::uint32_t> spirv, const std::string& name);

}  // namespace redmap
