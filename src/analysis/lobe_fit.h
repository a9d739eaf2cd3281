// Fits the lobe model of a reflectance, a black box, and finds out how far it can be trusted (docs/normals.md).
#pragma once

#include <cstddef>

#include "lobes/lobe_model.h"
#include "shader/shader.h"

namespace redmap {

/// Fits pattern `pattern` with about 3 000 calls, and validates the fit with about 100 000 more against integrals by
/// brute force. Takes isotropic reflectances; of others `error` tells that the model is of no use. Safe to call from
/// several threads.
LobeModel fit_lobes(const BoundPatterns& patterns, std::size_t pattern);

}  // namespace redmap
