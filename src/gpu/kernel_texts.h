// The GLSL of the realtime renderer, src/gpu/kernels. Not part of the public interface.
#pragma once

#include <initializer_list>
#include <string>
#include <string_view>

namespace redmap {

/// The text of kernels/NAME.glsl.
std::string_view kernel_text(std::string_view name);
/// Several, one after the other.
std::string kernel_texts(std::initializer_list<std::string_view> names);

}  // namespace redmap
