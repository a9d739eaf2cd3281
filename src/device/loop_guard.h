// Loops that end: a change to SPIR-V as glslang makes it. Not part of the public interface.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace redmap {

/// Lets every loop ask the function `bool guard()` of the same text before each round, and leave when it says false.
/// The guard itself must be called somewhere, and have no loop. Throws Error where there is no such function.
std::vector<std::uint32_t> guard_loops(const std::vector<std::uint32_t>& spirv, const std::string& guard);

}  // namespace redmap
