#include "mesh_input.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cstdio>
#include <nlohmann/json.hpp>

#include "surface/mesh_units.h"
#include "surface/uv_quality.h"

namespace redmap::cli {

namespace {

void report_uv(const TriangleMesh& mesh, nlohmann::json& json) {
  if (mesh.uv_triangles.empty()) {
    fmt::print("no uv on all faces\n");
    json["uv"] = nullptr;
    return;
  }
  const UvReport report = judge_uv(mesh);
  fmt::print("uv: {}\n", report.problem.empty()
                             ? fmt::format("usable, {:.1f} % of {} tile{} covered", 100 * report.coverage,
                                           report.tiles.size(), report.tiles.size() == 1 ? "" : "s")
                             : "not usable: " + report.problem);
  json["uv"] = {{"problem", report.problem},
                {"tiles", report.tiles},
                {"coverage", report.coverage},
                {"overlap_texels", report.overlapping_texels},
                {"mirrored_texels", report.mirrored_texels},
                {"degenerate_area", report.degenerate_area},
                {"triangles_outside", report.triangles_outside}};
}

}  // namespace

void add_mesh_input(CLI::App& sub, MeshInput& input) {
  sub.add_option("mesh", input.path, "the mesh to read: .obj, .ply, .stl, .gltf or .glb")->required();
  sub.add_option("--up", input.up, "which axis is up in the file; z is turned to y")->check(CLI::IsMember({"y", "z"}));
  sub.add_option("--unit", input.unit, "the file's unit of length; scaled to metres")
      ->check(CLI::IsMember(unit_names()));
  sub.add_option("--part", input.part, "only the group or material of this name")->type_name("NAME");
}

TriangleMesh read_mesh_input(const MeshInput& input, nlohmann::json& json) {
  MeshReport report;
  TriangleMesh mesh = read_mesh(input.path, &report);
  if (report.zero_area_triangles > 0)
    fmt::print("{}: dropped {} zero-area triangles\n", input.path, report.zero_area_triangles);
  for (const std::string& line : report.not_applied) fmt::print(stderr, "{}\n", line);
  json["not_applied"] = report.not_applied;
  json["zero_area_triangles"] = report.zero_area_triangles;

  MeshUnits units;
  if (!input.up.empty()) units.up = input.up == "z" ? UpAxis::kZ : UpAxis::kY;
  if (!input.unit.empty()) units.unit = input.unit;
  apply_units(mesh, units);
  const std::string assumed = describe_units(input.path, units);
  fmt::print("{}\n", assumed);
  json["units"] = assumed;

  const std::vector<std::string> parts = part_names(mesh);
  if (!parts.empty()) fmt::print("parts: {}\n", fmt::join(parts, ", "));
  json["parts"] = parts;
  if (!input.part.empty()) {
    keep_triangles(mesh, select_part(mesh, input.part));
    drop_unused_vertices(mesh);
  }
  report_uv(mesh, json);
  return mesh;
}

}  // namespace redmap::cli
