// `redmap bench export`: what exported materials lose beside the map that they are made from.
#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

#include "base/parallel.h"
#include "commands.h"
#include "common.h"
#include "export/export_bench.h"
#include "machine.h"

namespace redmap::cli {

namespace {

struct Options {
  bench::ExportBenchOptions measured;
  CommonOptions common;
};

nlohmann::json to_json(const bench::ExportBenchRow& row) {
  return {{"object", row.object},
          {"shader", row.shader},
          {"minification", row.minification},
          {"basis", row.basis},
          {"verdict", row.verdict},
          {"fit_errors", row.fit_errors},
          {"rmse_map", row.rmse_map},
          {"rmse_materials", row.rmse_materials},
          {"rmse_one_material", row.rmse_one_material},
          {"rmse_64", row.rmse_64},
          {"reference_residual", row.reference_residual}};
}

void print_table(const std::vector<bench::ExportBenchRow>& rows) {
  fmt::print("{:<8} {:<18} {:>2} {:>3} {:>8} {:>8} {:>8} {:>6} {:>8} {:>8}\n", "object", "shader", "k", "m",
             "worst fit", "map", "k mats", "ratio", "one mat", "64 spp");
  for (const bench::ExportBenchRow& row : rows)
    fmt::print("{:<8} {:<18} {:>2} {:>3.0f} {:>8.4f} {:>8.4f} {:>8.4f} {:>6.2f} {:>8.4f} {:>8.4f}\n", row.object,
               row.shader, row.basis, row.minification, *std::ranges::max_element(row.fit_errors), row.rmse_map,
               row.rmse_materials, row.rmse_materials / row.rmse_map, row.rmse_one_material, row.rmse_64);
}

void run(Options& options) {
  const ThreadLimit threads(static_cast<std::size_t>(options.common.threads));
  std::optional<Progress> progress(std::in_place, "measuring");
  options.measured.progress = [&](double part) { progress->update(part); };
  options.measured.cancelled = interrupted;
  const std::vector<bench::ExportBenchRow> rows = measure_exports(options.measured);
  progress.reset();
  print_table(rows);
  nlohmann::json json{{"machine", machine_json()}, {"rows", nlohmann::json::array()}};
  for (const bench::ExportBenchRow& row : rows) json["rows"].push_back(to_json(row));
  write_json(options.common.json, json);
}

}  // namespace

void add_bench_export(CLI::App& bench_app) {
  auto options = std::make_shared<Options>();
  bench::ExportBenchOptions& measured = options->measured;
  CLI::App* sub = bench_app.add_subcommand("export", "Error of exported materials beside that of their map");
  sub->add_option("--objects", measured.objects, "sphere, cylinder, bunny, dragon")
      ->delimiter(',')
      ->capture_default_str();
  sub->add_option("--shaders", measured.shaders, "Library shaders (all if not given)")->delimiter(',');
  sub->add_option("--minifications", measured.minifications, "Texels across a pixel")
      ->delimiter(',')
      ->check(CLI::Range(0.05, 4096.0))
      ->capture_default_str();
  sub->add_option("--size", measured.map_size, "Texels across a map")
      ->check(CLI::Range(1, 16384))
      ->capture_default_str();
  sub->add_option("--reference-spp", measured.reference_spp, "Samples a pixel of the reference, in two halves")
      ->check(CLI::Range(8, 1 << 20))
      ->capture_default_str();
  sub->add_option("--views", measured.views, "Views a case")->check(CLI::Range(1, 1000))->capture_default_str();
  sub->add_option("--models", measured.models, "Folder of bunny_10k.obj and dragon_20k.obj")->capture_default_str();
  add_common_options(*sub, options->common);
  sub->footer("Example: redmap bench export --shaders noise,marble --json export.json");
  sub->callback([options] { run(*options); });
}

}  // namespace redmap::cli
