// Weights of points whose keys a device has made: known ones looked up, the few others fitted on the CPU. Not part of
// the public interface.
#pragma once

#include <cstdint>
#include <vector>

#include "bake/project.h"
#include "gpu/bake_kernels.h"

namespace redmap {

/// What the shader of weight_text() puts out for the texels of `batch`, from what that of key_text() did.
std::vector<std::uint32_t> weigh_by_keys(const BakeJob& job, const SampledTexels& sampled, const ChosenBasis& basis,
                                         const KnownWeights& known, const PointBatch& batch);

}  // namespace redmap
