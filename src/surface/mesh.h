// Triangle meshes: positions, normals, and an atlas that gives every place on them its own uv (paper, section 4.1).
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <vector>

#include "surface/surface.h"

namespace redmap {

using Triangle = std::array<std::uint32_t, 3>;

/// Separate indices for positions, normals and uv, as OBJ has them. `uv` and `uv_triangles` are empty together where
/// the mesh has no atlas yet; `normals` likewise where normals were not given.
struct TriangleMesh {
  std::vector<Vec3> positions;
  std::vector<Triangle> triangles;
  std::vector<Vec3> normals;
  std::vector<Triangle> normal_triangles;
  std::vector<Vec2> uv;
  std::vector<Triangle> uv_triangles;
};

/// Reads OBJ, PLY, glTF or GLB by extension. Drops zero-area triangles (their count is returned through `report` if
/// given). Throws Error on anything missing, truncated, out of range or not finite.
struct MeshReport {
  std::size_t zero_area_triangles = 0;
};
TriangleMesh read_mesh(const std::filesystem::path& path, MeshReport* report = nullptr);
/// Writes OBJ or binary PLY by extension, through a temporary name.
void write_mesh(const std::filesystem::path& path, const TriangleMesh& mesh);

/// Area-weighted vertex normals, for meshes without their own.
void compute_normals(TriangleMesh& mesh);

/// A renderable surface of a mesh that has uv: throws Error if it has none.
std::shared_ptr<const Surface> make_mesh_surface(TriangleMesh mesh);

}  // namespace redmap
