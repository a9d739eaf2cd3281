// Which parameters of a baked shader may still be changed: those that change the look of its parts, and not where they
// are. Not part of the public interface.
#pragma once

#include <vector>

#include "map/reduction_map.h"
#include "shader/shader.h"
#include "surface/surface.h"

namespace redmap {

/// One flag a parameter, in the order of shader.info().parameters: whether the weights of `map` hold for its other
/// values too, with the shader at the places of the basis asked anew. Found out by asking the shader, which stays a
/// black box, at some places with some values; none where the shader hides its frames.
std::vector<bool> live_parameters(const ReductionMap& map, const Surface& surface, const Shader& shader);

}  // namespace redmap
