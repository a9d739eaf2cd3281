// Reads weights out of a rendered pixel: a shader whose basis reflectances shine, each in a colour of its own, in place
// of the map's. Whatever a frame does to weights on the way, filters, seams, clusters, shows up in the pixel.
#pragma once

#include <memory>

#include "shader/shader.h"

namespace redmap {

/// Weights that one pixel can hold: its channels.
inline constexpr int kProbedWeights = 3;

/// Bound to the places of a basis, reflectance `first` shines red, the next green, the next blue; all else is dark.
std::shared_ptr<const Shader> make_weight_probe(int first);

}  // namespace redmap
