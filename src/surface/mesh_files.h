// The mesh file formats, one function each. read_mesh() checks what is common to all of them.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "surface/mesh.h"

namespace redmap {

/// `shape`: positions by which polygons are cut into triangles instead of the file's own, so that a deformed mesh is
/// cut as the one at rest; null for the file's own.
TriangleMesh read_obj(const std::filesystem::path& path, const std::vector<Vec3>* shape = nullptr);
TriangleMesh read_ply(const std::filesystem::path& path, const std::vector<Vec3>* shape = nullptr);
TriangleMesh read_stl(const std::filesystem::path& path);
/// glTF, or GLB where `binary`; uv from TEXCOORD_`uv_set`. Adds a line to `not_applied` for skins and for morphs.
TriangleMesh read_gltf(const std::filesystem::path& path, bool binary, int uv_set,
                       std::vector<std::string>& not_applied);

/// The extension with its dot, in lower case.
std::string lower_extension(const std::filesystem::path& path);
/// The whole file; throws Error if it cannot be read or is empty.
std::string read_bytes(const std::filesystem::path& path);

}  // namespace redmap
