// `redmap bench shading-normals`: how well, and in how many calls, the shading normals of black boxes are found.
#include <fmt/format.h>

#include <memory>
#include <nlohmann/json.hpp>

#include "base/parallel.h"
#include "commands.h"
#include "common.h"
#include "shading_normals/shading_normals.h"

namespace redmap::cli {

namespace {

struct Options {
  CommonOptions common;
  bench::ShadingNormalsOptions measured;
};

nlohmann::json to_json(const bench::ShadingNormalsRow& row) {
  return {{"model", row.model},
          {"method", row.method},
          {"median_radians", row.median_radians},
          {"p95_radians", row.p95_radians},
          {"calls", row.calls},
          {"found", row.found},
          {"wrong_reported_as_found", row.wrong_reported_as_found}};
}

void run(const Options& options) {
  const ThreadLimit threads(static_cast<std::size_t>(options.common.threads));
  nlohmann::json json{{"rows", nlohmann::json::array()}};
  fmt::print("{:<24} {:<12} {:>10} {:>10} {:>7} {:>6} {:>6}\n", "model", "method", "median rad", "p95 rad", "calls",
             "found", "wrong");
  for (const bench::ShadingNormalsRow& row : bench::measure_shading_normals(options.measured)) {
    fmt::print("{:<24} {:<12} {:>10.1e} {:>10.1e} {:>7.1f} {:>6} {:>6}\n", row.model, row.method, row.median_radians,
               row.p95_radians, row.calls, row.found, row.wrong_reported_as_found);
    json["rows"].push_back(to_json(row));
  }
  write_json(options.common.json, json);
}

}  // namespace

void add_bench_shading_normals(CLI::App& bench_app) {
  auto options = std::make_shared<Options>();
  bench::ShadingNormalsOptions& measured = options->measured;
  CLI::App* sub = bench_app.add_subcommand("shading-normals", "Shading normals of black boxes: models x methods");
  sub->add_option("--normals", measured.normals, "Random normals a model")
      ->check(CLI::Range(1, 1 << 20))
      ->capture_default_str();
  sub->add_option("--tilt", measured.tilt_degrees, "Largest angle to the geometric normal, degrees")
      ->check(CLI::Range(0.0, 89.0))
      ->capture_default_str();
  sub->add_flag("--single-precision", measured.single_precision, "Directions and radiance as floats");
  add_common_options(*sub, options->common);
  sub->footer("Example: redmap bench shading-normals --json normals.json");
  sub->callback([options] { run(*options); });
}

}  // namespace redmap::cli
