// The surface of a map as vertices for other renderers: uv of the atlas, normals, and the tangents that the map's
// normals are about.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "surface/surface.h"

namespace redmap {

struct MeshBuffers {
  std::vector<std::array<float, 3>> positions, normals;
  std::vector<std::array<float, 4>> tangents;  ///< w: 1, the bitangent is normal x tangent
  std::vector<std::array<float, 2>> uv;        ///< v upwards
  std::vector<std::uint32_t> triangles;        ///< of the mesh, a vertex: one of its chart
  std::vector<std::uint32_t> indices;
  Vec3 lower, upper;
};

/// A mesh as it is, at rest; spheres and cylinders as a grid.
MeshBuffers mesh_buffers(const Surface& surface);
/// For a program of one's own: 12 floats a vertex (position, normal, tangent, uv with v upwards, triangle), then the
/// indices.
std::string mesh_bytes(const MeshBuffers& mesh);

}  // namespace redmap
