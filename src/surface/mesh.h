// Triangle meshes: positions, normals, and an atlas that gives every place on them its own uv (paper, section 4.1).
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "surface/surface.h"

namespace redmap {

using Triangle = std::array<std::uint32_t, 3>;

/// Where in its file a triangle came from: OBJ group or object, glTF node, STL solid; and its material. Either may be
/// empty.
struct MeshPart {
  std::string group, material;
};

/// Separate indices for positions, normals and uv, as OBJ has them. `uv` and `uv_triangles` are empty together where
/// the mesh has no atlas yet; `normals` likewise where normals were not given. `triangle_parts` says which of `parts`
/// each triangle belongs to; both are empty where the file names none.
struct TriangleMesh {
  std::vector<Vec3> positions;
  std::vector<Triangle> triangles;
  std::vector<Vec3> normals;
  std::vector<Triangle> normal_triangles;
  std::vector<Vec2> uv;
  std::vector<Triangle> uv_triangles;
  std::vector<MeshPart> parts;
  std::vector<std::uint32_t> triangle_parts;
};

struct MeshReport {
  std::size_t zero_area_triangles = 0;
  std::vector<std::string> not_applied;  ///< one line each: what the file has and reading it passes over
};

/// Reads OBJ, PLY, STL, glTF or GLB by extension. Drops zero-area triangles (their count is returned through `report`
/// if given). `uv_set`: which of a glTF file's TEXCOORD attributes are the uv. Throws Error on anything missing,
/// truncated, out of range or not finite.
TriangleMesh read_mesh(const std::filesystem::path& path, MeshReport* report = nullptr, int uv_set = 0);

/// A mesh and the same mesh deformed: the same triangles in the same order.
struct PosedMesh {
  TriangleMesh rest, posed;
};

/// Reads both files as read_mesh() does, except that polygons of both are cut as those of `rest` are, and that
/// triangles are dropped from both where they have no area at rest. Throws Error where their topologies differ.
PosedMesh read_posed_mesh(const std::filesystem::path& rest, const std::filesystem::path& posed,
                          MeshReport* report = nullptr, int uv_set = 0);

/// Writes OBJ (with groups and materials) or binary PLY by extension, through a temporary name.
void write_mesh(const std::filesystem::path& path, const TriangleMesh& mesh);

/// Keeps the triangles t with `keep[t] != 0`, and of positions, normals and uv all.
void keep_triangles(TriangleMesh& mesh, std::span<const std::uint8_t> keep);

/// Drops the positions and normals that no triangle uses, the others in order of first use.
void drop_unused_vertices(TriangleMesh& mesh);

/// Every name that select_part() knows in `mesh`: groups, then materials, each once.
std::vector<std::string> part_names(const TriangleMesh& mesh);
/// For each triangle whether its group or material is called `name`. Throws Error if none is.
std::vector<std::uint8_t> select_part(const TriangleMesh& mesh, const std::string& name);

/// Area-weighted vertex normals, for meshes without their own.
void compute_normals(TriangleMesh& mesh);

/// A renderable surface of a mesh that has uv in [0, 1]: throws Error if it has none.
std::shared_ptr<const Surface> make_mesh_surface(TriangleMesh mesh);
/// A deformed mesh that is shaded where it was at rest: maps are baked from and stay valid for `rest`, whose uv are
/// used; rays hit `posed`.
std::shared_ptr<const Surface> make_posed_surface(PosedMesh mesh);

}  // namespace redmap
