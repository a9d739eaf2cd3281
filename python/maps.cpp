// Reduction maps: files, levels as arrays, lookups, and shading by them.
#include "map/reduction_map.h"

#include "arrays.h"
#include "map/map_file.h"
#include "map_origin.h"
#include "surface/mesh.h"
#include "surface_batch.h"

namespace redmap::python {
namespace {

using SharedMap = std::shared_ptr<const ReductionMap>;
/// Bytes of a level: rows, columns, channels.
using LevelView = nb::ndarray<nb::numpy, const std::uint8_t, nb::ndim<3>>;

SharedMap load_map(const std::filesystem::path& path) {
  const nb::gil_scoped_release release;
  auto map = std::make_shared<ReductionMap>(read_map(path));
  make_origin_absolute(map->shader_origin, path.parent_path());
  return map;
}

void save_map(const SharedMap& map, const std::filesystem::path& path) {
  const nb::gil_scoped_release release;
  ReductionMap placed = *map;
  make_origin_relative(placed.shader_origin, path.parent_path());
  write_map(path, placed);
}

/// `count` components of every texel, from `first` on.
LevelView components(const SharedMap& map, int level, std::size_t first, std::size_t count) {
  const WeightPyramid& weights = map->weights;
  if (level < 0 || level >= weights.levels())
    throw Error("map: expected a level from 0 to {}, found {}", weights.levels() - 1, level);
  const Extent extent = weights.extent(level);
  const std::uint8_t* data = weights.row(level, 0).data();
  const std::int64_t row_stride = extent.height > 1 ? weights.row(level, 1).data() - data : 0;
  const auto [kept, owner] = keep(SharedMap(map));
  return LevelView(data + first,
                   {static_cast<std::size_t>(extent.height), static_cast<std::size_t>(extent.width), count}, owner,
                   {row_stride, weights.texel_stride(), 1});
}

std::vector<Footprint> footprints_of(const RowsIn<2>& uv, const RowsIn<2>& duv_dx, const RowsIn<2>& duv_dy) {
  const std::size_t count = uv.shape(0);
  const auto centres = vectors_of<Vec2>("uv", uv, count), dx = vectors_of<Vec2>("duv_dx", duv_dx, count),
             dy = vectors_of<Vec2>("duv_dy", duv_dy, count);
  std::vector<Footprint> footprints(count);
  for (std::size_t i = 0; i < count; ++i) footprints[i] = {centres[i], dx[i], dy[i]};
  return footprints;
}

/// Coverage (N), weights (N, k).
std::pair<nb::ndarray<nb::numpy, float, nb::ndim<1>>, nb::ndarray<nb::numpy, float, nb::ndim<2>>> lookup(
    const ReductionMap& map, const RowsIn<2>& uv, const RowsIn<2>& duv_dx, const RowsIn<2>& duv_dy) {
  const std::vector<Footprint> footprints = footprints_of(uv, duv_dx, duv_dy);
  const std::size_t channels = map.basis.size();
  std::vector<float> coverage(footprints.size()), weights(footprints.size() * channels);
  {
    const nb::gil_scoped_release release;
    std::vector<FilteredTexel> texels(footprints.size());
    map.weights.lookup(footprints, LookupFilter::kVarianceMatched, texels);
    for (std::size_t i = 0; i < texels.size(); ++i) {
      coverage[i] = texels[i].coverage;
      std::copy_n(texels[i].channel.begin(), channels, weights.begin() + static_cast<std::ptrdiff_t>(i * channels));
    }
  }
  const std::size_t count = footprints.size();
  const auto [kept_coverage, coverage_owner] = keep(std::move(coverage));
  const auto [kept_weights, weights_owner] = keep(std::move(weights));
  return {{kept_coverage->data(), {count}, coverage_owner}, {kept_weights->data(), {count, channels}, weights_owner}};
}

RowsOut<3> shade(const std::shared_ptr<const Surface>& surface, const std::shared_ptr<const Shader>& shader,
                 const SharedMap& map, const IndicesIn& primitive, const RowsIn<2>& coordinates,
                 const RowsIn<2>& duv_dx, const RowsIn<2>& duv_dy, const RowsIn<3>& to_light,
                 const RowsIn<3>& to_viewer) {
  const std::vector<Vec2> places = vectors_of<Vec2>("coordinates", coordinates, primitive.shape(0));
  std::vector<HitCoordinates> where(places.size());
  for (std::size_t i = 0; i < where.size(); ++i) where[i] = {primitive.view()(i), places[i]};
  std::vector<SurfaceHit> hits(where.size());
  if (const TriangleMesh* mesh = surface->mesh())
    for (const HitCoordinates& at : where)
      if (at.primitive >= mesh->triangles.size())
        throw Error("primitive: expected triangles 0 to {}, found {}", mesh->triangles.size() - 1, at.primitive);
  surface->complete(where, hits);
  ShadingBatch batch = batch_of(std::move(hits), to_light, to_viewer);
  const auto dx = vectors_of<Vec2>("duv_dx", duv_dx, where.size()),
             dy = vectors_of<Vec2>("duv_dy", duv_dy, where.size());
  for (std::size_t i = 0; i < where.size(); ++i) batch.footprints.push_back({batch.hits[i].uv, dx[i], dy[i]});
  return shade_batch(*make_map_shading(shader, map, surface), batch);
}

void bind_certificate(nb::module_& module) {
  nb::class_<Certificate> certificate(module, "Certificate",
                                      "What a map says about its own error, which is that of white paper at 1.");
  nb::class_<Certificate::Row>(certificate, "Row", doc::Certificate_Row)
      .def_ro("minification", &Certificate::Row::minification)
      .def_ro("pixels", &Certificate::Row::pixels)
      .def_ro("rms_error", &Certificate::Row::rms_error)
      .def_ro("mean_error", &Certificate::Row::mean_error)
      .def_ro("bound", &Certificate::Row::bound, doc::Certificate_Row_bound);
  certificate.def_ro("coverage", &Certificate::coverage)
      .def_ro("quality", &Certificate::quality, doc::Certificate_quality)
      .def_ro("samples", &Certificate::samples, doc::Certificate_samples)
      .def_ro("rows", &Certificate::rows)
      .def_ro("weakest", &Certificate::weakest, doc::Certificate_weakest)
      .def_ro("reason", &Certificate::reason, doc::Certificate_reason);
}

void bind_basis_place(nb::module_& module) {
  nb::class_<BasisPlace>(module, "BasisPlace", doc::BasisPlace)
      .def_ro("position", &BasisPlace::position)
      .def_ro("normal", &BasisPlace::normal)
      .def_ro("tangent", &BasisPlace::tangent)
      .def_ro("uv", &BasisPlace::uv);
}

}  // namespace

void bind_maps(nb::module_& module) {
  bind_certificate(module);
  bind_basis_place(module);
  nb::class_<ReductionMap>(module, "ReductionMap", "The reduction map of a shader on a surface.")
      .def_ro("shader", &ReductionMap::shader)
      .def_ro("parameters", &ReductionMap::parameters, doc::ReductionMap_parameters)
      .def_ro("size", &ReductionMap::size, doc::ReductionMap_size)
      .def_ro("tolerance", &ReductionMap::tolerance, doc::ReductionMap_tolerance)
      .def_ro("residual", &ReductionMap::residual, doc::ReductionMap_residual)
      .def_prop_ro(
          "verdict", [](const ReductionMap& m) { return verdict_name(m.verdict); }, doc::verdict_name)
      .def_ro("verdict_reason", &ReductionMap::verdict_reason)
      .def_ro("basis", &ReductionMap::basis)
      .def_ro("certificate", &ReductionMap::certificate, doc::ReductionMap_certificate)
      .def_prop_ro(
          "has_normals", [](const ReductionMap& m) { return !m.normals.empty(); }, doc::ReductionMap_normals)
      .def_prop_ro("bytes", &texel_bytes, doc::texel_bytes)
      .def_prop_ro("levels", [](const ReductionMap& m) { return m.weights.levels(); })
      .def_prop_ro(
          "scales",
          [](const ReductionMap& m) {
            return nb::tuple(nb::cast(std::vector<float>(m.weights.scales().begin(), m.weights.scales().end())));
          },
          nb::sig("def scales(self) -> tuple[float, ...]"), doc::Pyramid_scales)
      .def(
          "weights", [](const SharedMap& self, int level) { return components(self, level, 1, self->basis.size()); },
          "level"_a = 0,
          "The weights of a level, (height, width, k) bytes that share the map's memory: byte / 255 * scales[basis], "
          "not "
          "multiplied by coverage. Raises Error.")
      .def(
          "coverage", [](const SharedMap& self, int level) { return components(self, level, 0, 1); }, "level"_a = 0,
          "The coverage of a level, (height, width, 1) bytes that share the map's memory. Raises Error.")
      .def("lookup", &lookup, "uv"_a, "duv_dx"_a, "duv_dy"_a, doc::Pyramid_lookup)
      .def("save", &save_map, "path"_a, doc::write_map);
  module.def("load_map", &load_map, "path"_a, doc::read_map);
  module.def(
      "shade", &shade, "surface"_a, "shader"_a, "map"_a, "primitive"_a, "coordinates"_a, "duv_dx"_a, "duv_dy"_a,
      "to_light"_a, "to_viewer"_a,
      "The radiance of N hits by the map, as in a frame: under a light of unit irradiance, with the shader's "
      "emission. Hits are triangles (N) and barycentric weights of their vertices 1 and 2 (N, 2); on spheres and "
      "cylinders zeros and uv. `duv_dx`, `duv_dy` (N, 2): how uv changes over the footprint. Directions (N, 3) in "
      "object space. Raises Error.");
}

}  // namespace redmap::python
