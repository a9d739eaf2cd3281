// Surfaces: analytic ones, and meshes from arrays or files.
#include "surface/surface.h"

#include "arrays.h"
#include "scene/mesh_loader.h"
#include "surface/atlas.h"
#include "surface/mesh.h"

namespace redmap::python {
namespace {

using Surfaces = std::vector<std::shared_ptr<const Surface>>;

/// Throws Error on indices that there is no vertex for.
std::vector<Triangle> triangles_of(std::string_view name, const TrianglesIn& array, std::size_t vertices) {
  const auto view = array.view();
  std::vector<Triangle> triangles(array.shape(0));
  for (std::size_t t = 0; t < triangles.size(); ++t)
    for (std::size_t c = 0; c < 3; ++c) {
      triangles[t][c] = view(t, c);
      if (view(t, c) >= vertices)
        throw Error("{}: expected vertices 0 to {}, found {} in triangle {}", name, static_cast<long>(vertices) - 1,
                    view(t, c), t);
    }
  return triangles;
}

std::shared_ptr<const Surface> mesh(const RowsIn<3>& positions, const TrianglesIn& triangles,
                                    const std::optional<RowsIn<2>>& uv, const std::optional<TrianglesIn>& uv_triangles,
                                    const std::optional<RowsIn<3>>& normals) {
  TriangleMesh mesh;
  mesh.positions = vectors_of<Vec3>("positions", positions, positions.shape(0));
  mesh.triangles = triangles_of("triangles", triangles, mesh.positions.size());
  if (normals) {
    mesh.normals = vectors_of<Vec3>("normals", *normals, mesh.positions.size());
    mesh.normal_triangles = mesh.triangles;
  } else {
    compute_normals(mesh);
  }
  if (uv) {
    mesh.uv = vectors_of<Vec2>("uv", *uv, uv_triangles ? uv->shape(0) : mesh.positions.size());
    mesh.uv_triangles = uv_triangles ? triangles_of("uv_triangles", *uv_triangles, mesh.uv.size()) : mesh.triangles;
    require_rows("uv_triangles", mesh.uv_triangles.size(), mesh.triangles.size());
  }
  const nb::gil_scoped_release release;
  if (!uv) unwrap(mesh);
  return make_mesh_surface(std::move(mesh));
}

Surfaces read_surfaces(const std::filesystem::path& path, const std::string& part) {
  const nb::gil_scoped_release release;
  MeshRequest request;
  request.mesh = path, request.part = part;
  Surfaces surfaces;
  for (const LoadedMesh::Tile& tile : load_mesh(request, path.parent_path() / "maps").tiles)
    surfaces.push_back(tile.surface);
  return surfaces;
}

}  // namespace

void bind_surfaces(nb::module_& module) {
  nb::class_<Surface>(module, "Surface", "A surface that can be textured.")
      .def(
          "map_extent",
          [](const Surface& surface, int size) {
            const Extent extent = surface.map_extent(size);
            return std::pair(extent.width, extent.height);
          },
          "size"_a, doc::Surface_map_extent)
      .def_prop_ro("area", &Surface::area, doc::Surface_area)
      .def_prop_ro("uv_area", &Surface::uv_area, doc::Surface_area)
      .def_prop_ro("wraps_u", &Surface::wraps_u, doc::Surface_wraps_u)
      .def_prop_ro("lower", &Surface::lower, doc::Surface_lower)
      .def_prop_ro("upper", &Surface::upper, doc::Surface_lower);
  module.def("sphere", &make_sphere, "radius"_a = 1.0f, doc::make_sphere);
  module.def("cylinder", &make_cylinder, "radius"_a = 1.0f, "height"_a = 2.0f, doc::make_cylinder);
  module.def(
      "mesh", &mesh, "positions"_a, "triangles"_a, "uv"_a = nb::none(), "uv_triangles"_a = nb::none(),
      "normals"_a = nb::none(),
      "A mesh of arrays: positions (N, 3), triangles (M, 3) of indices into them, and where there are, uv (N, 2) in "
      "[0, 1], or with indices of their own uv_triangles (M, 3), and normals (N, 3). New uv are made where there "
      "are none. Raises Error.");
  module.def("read_surfaces", &read_surfaces, "path"_a, "part"_a = "",
             "The surfaces of an OBJ, PLY, STL, glTF or GLB file, one for each tile of its uv, as a scene would read "
             "it: uv that cannot be used are made anew and remembered in maps/ beside the file. Raises Error.");
}

}  // namespace redmap::python
