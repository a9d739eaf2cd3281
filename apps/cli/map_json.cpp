#include "map_json.h"

#include <nlohmann/json.hpp>

#include "certificate_text.h"
#include "machine.h"
#include "map/map_file.h"

namespace redmap::cli {

nlohmann::json map_json(const ReductionMap& map) {
  nlohmann::json places = nlohmann::json::array();
  for (const BasisPlace& p : map.basis)
    places.push_back({{"position", {p.position.x, p.position.y, p.position.z}},
                      {"normal", {p.normal.x, p.normal.y, p.normal.z}},
                      {"uv", {p.uv.x, p.uv.y}}});
  const Extent extent = map.weights.extent(0);
  nlohmann::json json{{"shader", map.shader},
                      {"parameters", map.parameters},
                      {"basis", map.basis.size()},
                      {"basis_places", places},
                      {"size", {extent.width, extent.height}},
                      {"levels", map.weights.levels()},
                      {"bytes_in_memory", texel_bytes(map)},
                      {"residual", map.residual},
                      {"tolerance", map.tolerance},
                      {"verdict", verdict_name(map.verdict)},
                      {"verdict_reason", map.verdict_reason}};
  if (map.certificate) json["certificate"] = certificate_json(*map.certificate);
  return json;
}

nlohmann::json bake_json(const ReductionMap& map, const BakeReport& report) {
  nlohmann::json stages = nlohmann::json::object();
  for (const BakeReport::Stage& stage : report.stages) stages[stage.name] = stage.seconds;
  nlohmann::json json = map_json(map);
  json["bake_seconds"] = report.seconds;
  json["peak_bytes"] = report.peak_bytes;
  json["stages"] = stages;
  json["covered_texels"] = report.covered_texels;
  json["refined_texels"] = report.refined_texels;
  json["distinct_reflectances"] = report.distinct_reflectances;
  json["outlier_basis"] = report.outlier_basis;
  json["added_directions"] = report.added_directions;
  json["held_out_residual"] = report.disagreement;
  json["held_out_residual_of_table"] = report.disagreement_of_table;
  if (map.hides_frames) json["hides_frames"] = true;
  if (report.probed_normals > 0)
    json["probed_normals"] = report.probed_normals, json["normals_not_found"] = report.normals_not_found;
  json["machine"] = machine_json();
  return json;
}

}  // namespace redmap::cli
