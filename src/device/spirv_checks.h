// What a shader may ask of a device, read from its SPIR-V. Not part of the public interface.
#pragma once

#include <cstdint>
#include <span>

namespace redmap {

/// Throws Error unless the shader keeps to core GLSL without work across invocations, and its arrays to kLargestArrays.
void check_spirv(std::span<const std::uint32_t> spirv);

/// Whether the shader uses numbers of 64 bits.
struct WideNumbers {
  bool floats = false, integers = false;
};
WideNumbers wide_numbers(std::span<const std::uint32_t> spirv);

/// Bytes of all arrays that a shader has for itself. On a CPU they lie on the stack, for eight invocations at once, and
/// compiling takes longer than in proportion: 80 kB took 4 s with llvmpipe of Mesa 22.3.
inline constexpr double kLargestArrays = 32768;

}  // namespace redmap
