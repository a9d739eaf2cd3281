// Baking on a Vulkan device (paper, sections 4.2 and 4.4): sampling, weights and pyramid in compute shaders, tile after
// tile. What lies between is the CPU's, above all the choice of the basis. docs/gpu.md.
#pragma once

#include <memory>
#include <string>

#include "bake/passes.h"
#include "shader/shader.h"

namespace redmap {

/// Why `shader` can only be baked on the CPU; empty if a device can do it.
std::string reason_to_bake_on_cpu(const Shader& shader, const BakeOptions& options);

/// The passes of a bake on `device`, as in Device::open(), which is opened when it begins. Same weights as on the CPU
/// but for the last bits of a device's arithmetic; same bytes whenever it runs again there. Bakes throw Error where
/// reason_to_bake_on_cpu() has one, and where the device is missing or fails. Errors of the shader are those of a bake
/// on the CPU.
std::unique_ptr<TexelPasses> make_device_passes(const std::string& device = "");

}  // namespace redmap
