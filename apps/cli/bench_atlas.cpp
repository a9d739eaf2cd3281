// redmap bench atlas: how good atlases are and what they cost, mesh by mesh.
#include <fmt/format.h>

#include <memory>
#include <nlohmann/json.hpp>

#include "atlas/atlas_bench.h"
#include "base/error.h"
#include "base/parallel.h"
#include "commands.h"
#include "common.h"
#include "machine.h"

namespace redmap::cli {

namespace {

struct BenchAtlasOptions {
  CommonOptions common;
  std::vector<std::string> meshes{"models/bunny_10k.obj", "models/dragon_20k.obj"};
  int size = 1024;
  bool far_errors = true;
};

nlohmann::json row_json(const bench::AtlasRow& row) {
  return {
      {"mesh", row.mesh},
      {"triangles", row.triangles},
      {"charts", row.atlas.charts},
      {"l2_stretch", row.atlas.l2_stretch},
      {"area_q05", row.area_q05},
      {"area_q95", row.area_q95},
      {"packing", row.atlas.packing},
      {"flips", row.atlas.flips},
      {"overlap_texels", row.overlap_texels},
      {"seconds", row.seconds},
      {"peak_bytes", row.peak_bytes},
      {"far_error_by_level",
       row.far ? nlohmann::json(std::vector<double>(row.far->by_level.begin(), row.far->by_level.end()))
               : nlohmann::json::array()},
      {"seam_rmse_over_interior", row.far ? nlohmann::json(row.far->seam_over_interior) : nlohmann::json(nullptr)},
      {"seam_rmse_over_recut", row.far ? nlohmann::json(row.far->seam_over_recut) : nlohmann::json(nullptr)},
      {"near_seam_rmse_over_recut", row.far ? nlohmann::json(row.far->near_seam_over_recut) : nlohmann::json(nullptr)}};
}

void print_row(const bench::AtlasRow& row) {
  fmt::print("{:<24} {:>9} {:>6} {:>6.3f} {:>5.2f} {:>5.2f} {:>6.1f} {:>5} {:>7} {:>7.2f} {:>7.0f}", row.mesh,
             row.triangles, row.atlas.charts, row.atlas.l2_stretch, row.area_q05, row.area_q95, 100 * row.atlas.packing,
             row.atlas.flips, row.overlap_texels, row.seconds, static_cast<double>(row.peak_bytes) / 1e6);
  if (row.far) {
    for (const double error : row.far->by_level) fmt::print(" {:.3f}", error);
    fmt::print("  {:.2f} {:.2f} {:.2f}", row.far->seam_over_interior, row.far->seam_over_recut,
               row.far->near_seam_over_recut);
  }
  fmt::print("\n");
}

void run_bench_atlas(const BenchAtlasOptions& options) {
  const ThreadLimit threads(static_cast<std::size_t>(options.common.threads));
  fmt::print("{:<24} {:>9} {:>6} {:>6} {:>5} {:>5} {:>6} {:>5} {:>7} {:>7} {:>7} {}\n", "mesh", "triangles", "charts",
             "l2", "a05", "a95", "% used", "flips", "overlap", "seconds", "MB",
             options.far_errors ? "error at levels 1 to 9, seams / elsewhere, / recut, / recut up to 3" : "");
  nlohmann::json json{{"machine", machine_json()}, {"rows", nlohmann::json::array()}};
  bool refused = false;
  for (const std::string& mesh : options.meshes) {
    stop_if_interrupted();
    try {
      const bench::AtlasRow row = bench::measure_atlas(mesh, options.size, options.far_errors);
      print_row(row);
      json["rows"].push_back(row_json(row));
    } catch (const Error& error) {
      fmt::print("{:<24} refused: {}\n", mesh, error.what());
      refused = true;
    }
  }
  write_json(options.common.json, json);
  if (refused) throw Error("bench atlas: not every mesh could be unwrapped");
}

}  // namespace

void add_bench_atlas(CLI::App& bench_app) {
  auto options = std::make_shared<BenchAtlasOptions>();
  CLI::App* sub = bench_app.add_subcommand(
      "atlas", "Stretch, packing, overlap, time, and error from near to far, of an atlas made for each mesh");
  sub->add_option("meshes", options->meshes, "Meshes: .obj, .ply, .gltf, .glb")->capture_default_str();
  sub->add_option("--size", options->size, "Texels across")->check(CLI::Range(16, 8192))->capture_default_str();
  sub->add_flag("!--no-far-errors", options->far_errors, "Leave out the errors by level, which take longest");
  add_common_options(*sub, options->common);
  sub->footer("Example: redmap bench atlas models/bunny_10k.obj --json atlas.json");
  sub->callback([options] { run_bench_atlas(*options); });
}

}  // namespace redmap::cli
