// What stands around the kernels' texts in an exported include file. Not part of the public interface.
#pragma once

#include <string_view>

namespace redmap {

/// Ways to memory, and what the kernels expect of a renderer. Comes first.
extern const std::string_view kGlslBefore;
/// Bound patterns.
extern const std::string_view kGlslPatterns;
/// The functions that a program calls.
extern const std::string_view kGlslAfter;

}  // namespace redmap
