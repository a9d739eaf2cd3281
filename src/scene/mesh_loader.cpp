#include "scene/mesh_loader.h"

#include <utility>

#include "base/error.h"
#include "surface/atlas.h"
#include "surface/mesh.h"
#include "surface/uv_quality.h"

namespace redmap {

namespace {

/// A mesh at rest, and in its pose where it has one.
struct Shapes {
  TriangleMesh rest;
  std::optional<TriangleMesh> posed;

  template <typename Action>
  void for_each(Action&& action) {
    action(rest);
    if (posed) action(*posed);
  }
};

Shapes read_shapes(const MeshRequest& request, MeshReport& report) {
  Shapes shapes;
  if (request.rest.empty()) {
    shapes.rest = read_mesh(request.mesh, &report, request.uv_set);
  } else {
    PosedMesh mesh = read_posed_mesh(request.rest, request.mesh, &report, request.uv_set);
    shapes = {std::move(mesh.rest), std::move(mesh.posed)};
  }
  shapes.for_each([&](TriangleMesh& mesh) {
    apply_units(mesh, request.units);
    // Before any part is cut out, so that parts meet without an edge.
    if (mesh.normal_triangles.empty()) compute_normals(mesh);
  });
  return shapes;
}

void keep(Shapes& shapes, std::span<const std::uint8_t> triangles) {
  shapes.for_each([&](TriangleMesh& mesh) {
    keep_triangles(mesh, triangles);
    drop_unused_vertices(mesh);
  });
}

/// Gives the mesh at rest the uv that it will be baked with; their tiles.
std::vector<int> settle_uv(const MeshRequest& request, const std::filesystem::path& cache_folder, TriangleMesh& mesh,
                           std::vector<std::string>& remarks) {
  const AtlasOptions atlas{.part_density = request.part_density};
  const std::string name = (request.rest.empty() ? request.mesh : request.rest).filename().string();
  if (request.uv == UvChoice::kFile && mesh.uv_triangles.empty())
    throw Error("{}: expected uv on every face, found none or on some only (uv = \"auto\" makes them)", name);
  if (request.uv == UvChoice::kFile && !request.part_density.empty())
    throw Error("{}: expected part_density where uv are made anew, found it with uv = \"file\"", name);
  const bool may_keep = request.uv != UvChoice::kUnwrap && request.part_density.empty();
  if (may_keep && !mesh.uv_triangles.empty()) {
    const UvReport report = judge_uv(mesh);
    if (report.problem.empty()) return report.tiles;
    if (request.uv == UvChoice::kFile) {
      if (report.tiles.empty()) throw Error("{}: {}: they cannot be used", name, report.problem);
      remarks.push_back(fmt::format("{}: {}: used all the same, as uv = \"file\" asks", name, report.problem));
      return report.tiles;
    }
    remarks.push_back(fmt::format("{}: {}: unwrapped anew (uv = \"file\" insists on them)", name, report.problem));
  }
  unwrap_cached(mesh, cache_folder, atlas);
  return {kFirstTile};
}

std::shared_ptr<const Surface> make_surface(Shapes shapes) {
  if (!shapes.posed) return make_mesh_surface(std::move(shapes.rest));
  return make_posed_surface(PosedMesh{std::move(shapes.rest), std::move(*shapes.posed)});
}

std::shared_ptr<const Surface> make_tile(const Shapes& shapes, int tile) {
  const std::vector<int> tiles = tiles_of(shapes.rest);
  std::vector<std::uint8_t> in_tile(tiles.size());
  for (std::size_t t = 0; t < tiles.size(); ++t) in_tile[t] = tiles[t] == tile;
  Shapes part = shapes;
  part.rest = extract_tile(part.rest, tile);
  drop_unused_vertices(part.rest);
  if (part.posed) {
    keep_triangles(*part.posed, in_tile);
    drop_unused_vertices(*part.posed);
  }
  return make_surface(std::move(part));
}

}  // namespace

LoadedMesh load_mesh(const MeshRequest& request, const std::filesystem::path& cache_folder) {
  LoadedMesh loaded;
  MeshReport report;
  Shapes shapes = read_shapes(request, report);
  const std::string name = request.mesh.filename().string();
  loaded.assumptions.push_back(describe_units(request.mesh, request.units));
  loaded.remarks = report.not_applied;
  if (report.zero_area_triangles > 0)
    loaded.assumptions.push_back(fmt::format("{}: dropped {} zero-area triangles", name, report.zero_area_triangles));
  if (!request.part.empty()) keep(shapes, select_part(shapes.rest, request.part));
  const std::vector<int> tiles = settle_uv(request, cache_folder, shapes.rest, loaded.remarks);
  if (tiles == std::vector{kFirstTile}) {
    loaded.tiles.push_back({0, make_surface(std::move(shapes))});
    return loaded;
  }
  for (const int tile : tiles) loaded.tiles.push_back({tile, make_tile(shapes, tile)});
  return loaded;
}

}  // namespace redmap
