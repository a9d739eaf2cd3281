// One primitive of a glTF file, read from accessors or unpacked from Draco, before its node has placed it.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "base/vec.h"

namespace redmap {

/// `normals` and `uv` are empty or as many as `positions`; `corners` index them, three a triangle.
struct GltfPrimitive {
  std::vector<Vec3> positions, normals;
  std::vector<Vec2> uv;
  std::vector<std::uint32_t> corners;
};

/// Draco's own numbers of a primitive's attributes.
struct DracoAttributes {
  std::uint32_t position = 0;
  std::optional<std::uint32_t> normal, uv;
};

/// Unpacks KHR_draco_mesh_compression. Throws Error, without the file's name, on whatever Draco does not accept.
GltfPrimitive decode_draco(std::span<const unsigned char> bytes, const DracoAttributes& attributes);

}  // namespace redmap
