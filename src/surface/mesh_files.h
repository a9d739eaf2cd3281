// The mesh file formats, one function each. read_mesh() checks what is common to all of them.
#pragma once

#include <filesystem>
#include <string>

#include "surface/mesh.h"

namespace redmap {

TriangleMesh read_obj(const std::filesystem::path& path);
TriangleMesh read_ply(const std::filesystem::path& path);
/// glTF, or GLB where `binary`.
TriangleMesh read_gltf(const std::filesystem::path& path, bool binary);

/// The whole file; throws Error if it cannot be read or is empty.
std::string read_bytes(const std::filesystem::path& path);

}  // namespace redmap
