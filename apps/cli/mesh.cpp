// `redmap mesh`: brings a mesh to a size and gives it an atlas.
#include <fmt/format.h>

#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>

#include "atlas_input.h"
#include "base/parallel.h"
#include "commands.h"
#include "common.h"
#include "mesh_input.h"
#include "surface/mesh.h"
#include "surface/prepare.h"

namespace redmap::cli {

namespace {

struct Options {
  MeshInput in;
  std::string out;
  PrepareOptions prepare;
  AtlasInput atlas;
  bool unwrap = false;
  CommonOptions common;
};

/// A mesh that is only converted or unwrapped keeps its vertices and normals as they are.
bool asks_for_preparation(const PrepareOptions& options) {
  return options.triangles > 0 || options.repair || options.weld_distance > 0 || options.largest_part ||
         options.unit_sphere;
}

void report_repair(const RepairReport& report, nlohmann::json& json) {
  fmt::print("repair: turned {} triangles, split off {} vertices, filled {} holes with {} triangles\n",
             report.turned_triangles, report.split_vertices, report.filled_holes, report.filling_triangles);
  json["repair"] = {{"turned_triangles", report.turned_triangles},
                    {"split_vertices", report.split_vertices},
                    {"filled_holes", report.filled_holes},
                    {"filling_triangles", report.filling_triangles}};
}

void report_preparation(const PrepareReport& report, bool repaired, bool verbose, nlohmann::json& json) {
  if (verbose)
    fmt::print(stderr,
               "welded {} vertices, dropped {} triangles, subdivided {} times; {} boundary and {} non-manifold edges\n",
               report.welded_vertices, report.dropped_triangles, report.subdivisions, report.boundary_edges,
               report.non_manifold_edges);
  if (repaired) report_repair(report.repair, json);
  json["prepare"] = {{"welded_vertices", report.welded_vertices},
                     {"dropped_triangles", report.dropped_triangles},
                     {"subdivisions", report.subdivisions},
                     {"boundary_edges", report.boundary_edges},
                     {"non_manifold_edges", report.non_manifold_edges}};
}

void report_atlas(const AtlasReport& report, nlohmann::json& json) {
  fmt::print("atlas: {} charts, L2 stretch {:.3f}, {:.1f} % of the square covered\n", report.charts, report.l2_stretch,
             100 * report.packing);
  json["atlas"] = {{"charts", report.charts}, {"l2_stretch", report.l2_stretch}, {"packing", report.packing}};
}

void run(Options& options) {
  const ThreadLimit threads(static_cast<std::size_t>(options.common.threads));
  nlohmann::json json;
  TriangleMesh mesh = read_mesh_input(options.in, json);
  if (asks_for_preparation(options.prepare))
    report_preparation(prepare(mesh, options.prepare), options.prepare.repair, options.common.verbose, json);
  stop_if_interrupted();
  if (options.unwrap) report_atlas(unwrap_as_asked(mesh, options.atlas, json), json);
  stop_if_interrupted();
  write_mesh(options.out, mesh);
  fmt::print("{}: {} vertices, {} triangles\n", options.out, mesh.positions.size(), mesh.triangles.size());
  json["vertices"] = mesh.positions.size();
  json["triangles"] = mesh.triangles.size();
  write_json(options.common.json, json);
}

}  // namespace

void add_mesh_command(CLI::App& app) {
  CLI::App* sub = app.add_subcommand("mesh", "Bring a mesh to a size, give it an atlas, convert it");
  sub->footer(
      "Examples:\n"
      "  redmap mesh bunny.ply -o bunny_10k.obj --triangles 10000 --unit-sphere\n"
      "  redmap mesh part.glb -o part.obj --unwrap");
  auto options = std::make_shared<Options>();
  add_mesh_input(*sub, options->in);
  sub->add_option("-o,--output", options->out, "the mesh to write: .obj or .ply")->required();
  sub->add_option("--triangles", options->prepare.triangles, "subdivide and simplify to about as many triangles");
  sub->add_option("--weld", options->prepare.weld_distance,
                  "make vertices one that are this near, as a part of the bounding box's diagonal")
      ->check(CLI::Range(0.0, 0.1));
  sub->add_flag("--repair", options->prepare.repair,
                "turn triangles the same way, split what is not manifold, fill small holes");
  sub->add_flag("--largest-part", options->prepare.largest_part, "keep only the largest connected part");
  sub->add_flag("--unit-sphere", options->prepare.unit_sphere, "move and scale it into the unit sphere at the origin");
  sub->add_flag("--unwrap", options->unwrap, "make an atlas");
  add_atlas_input(*sub, options->atlas);
  add_common_options(*sub, options->common);
  sub->callback([options] { run(*options); });
}

}  // namespace redmap::cli
