// Averaged material parameters and slopes of normals as a device reads them. Not part of the public interface.
#pragma once

#include "device/device_memory.h"
#include "gpu/frame_blocks.h"
#include "gpu/object_text.h"
#include "map/object_data.h"

namespace redmap {

/// `data` has parameters, and slopes of the same size or none.
void set_parameter_traits(const ObjectData& data, ObjectTraits& traits);
void set_parameter_block(const ObjectData& data, ObjectBlock& block);
/// Parameters, then slopes, then coverage where it is not 1 everywhere, four channels a layer, all multiplied by
/// coverage. 16-bit floats: what engines keep such textures in, or better.
LayeredTexture make_parameter_texture(const Device& device, const ObjectData& data);

}  // namespace redmap
