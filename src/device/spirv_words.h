// SPIR-V as words: instruction after instruction (specification, section 2.3). Not part of the public interface.
#pragma once

#include <cstdint>
#include <glslang/SPIRV/spirv.hpp>
#include <span>

#include "base/error.h"

namespace redmap {

/// Words before the first instruction.
inline constexpr std::size_t kSpirvHeader = 5;

inline spv::Op operation(std::span<const std::uint32_t> instruction) {
  return static_cast<spv::Op>(instruction[0] & spv::OpCodeMask);
}

/// Calls `visit(instruction)` for all of them.
template <typename Visit>
void for_each_instruction(std::span<const std::uint32_t> spirv, const Visit& visit) {
  for (std::size_t at = kSpirvHeader; at < spirv.size();) {
    const std::size_t words = spirv[at] >> spv::WordCountShift;
    if (words == 0 || words > spirv.size() - at)
      throw Error("expected SPIR-V, found an instruction of {} words", words);
    visit(spirv.subspan(at, words));
    at += words;
  }
}

}  // namespace redmap
