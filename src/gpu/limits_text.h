// What the kernels of src/gpu/kernels and the code of the CPU must agree on. Not part of the public interface.
#pragma once

#include <string>

namespace redmap {

/// GLSL constants redmap_least_facing and so on: kLeastFacing and the like of lobes/lobe_limits.h and
/// map/lookup_limits.h.
std::string limits_text();

}  // namespace redmap
