// `redmap bench coverage`: how often certificates hold on frames they never saw.
#include <fmt/format.h>

#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

#include "base/parallel.h"
#include "commands.h"
#include "common.h"
#include "coverage/coverage.h"
#include "machine.h"

namespace redmap::cli {

namespace {

struct Options {
  bench::CoverageOptions measured;
  CommonOptions common;
};

/// All rows as one.
bench::CoverageRow pooled(const std::vector<bench::CoverageRow>& rows) {
  bench::CoverageRow all;
  all.object = "all";
  for (const bench::CoverageRow& row : rows) {
    all.pixels += row.pixels, all.beyond += row.beyond;
    all.coverage += row.coverage * row.pixels;
    all.mean_error += row.mean_error * row.pixels, all.mean_bound += row.mean_bound * row.pixels;
  }
  all.coverage /= all.pixels, all.mean_error /= all.pixels, all.mean_bound /= all.pixels;
  return all;
}

nlohmann::json to_json(const bench::CoverageRow& row) {
  return {{"object", row.object},         {"shader", row.shader},       {"pixels", row.pixels},
          {"coverage", row.coverage},     {"rms_error", row.rms_error}, {"mean_error", row.mean_error},
          {"mean_bound", row.mean_bound}, {"beyond", row.beyond}};
}

void run(Options& options) {
  const ThreadLimit threads(static_cast<std::size_t>(options.common.threads));
  std::optional<Progress> progress(std::in_place, "measuring");
  options.measured.progress = [&](double part) { progress->update(part); };
  options.measured.cancelled = interrupted;
  const std::vector<bench::CoverageRow> rows = measure_coverage(options.measured);
  progress.reset();
  fmt::print("{:<8} {:<18} {:>6} {:>8} {:>8} {:>8} {:>8} {:>9} {:>6}\n", "object", "shader", "pixels", "coverage",
             "rms", "mean", "bound", "bound/rms", "beyond");
  nlohmann::json json{{"machine", machine_json()}, {"rows", nlohmann::json::array()}};
  for (const bench::CoverageRow& row : rows) {
    fmt::print("{:<8} {:<18} {:>6} {:>8.3f} {:>8.4f} {:>8.4f} {:>8.4f} {:>9.2f} {:>6}\n", row.object, row.shader,
               row.pixels, row.coverage, row.rms_error, row.mean_error, row.mean_bound, row.mean_bound / row.rms_error,
               row.beyond);
    json["rows"].push_back(to_json(row));
  }
  const bench::CoverageRow all = pooled(rows);
  fmt::print("{} pixels: {:.1f} % keep their bound\n", all.pixels, 100 * all.coverage);
  json["all"] = {{"pixels", all.pixels}, {"coverage", all.coverage}};
  write_json(options.common.json, json);
}

}  // namespace

void add_bench_coverage(CLI::App& bench_app) {
  auto options = std::make_shared<Options>();
  bench::CoverageOptions& measured = options->measured;
  measured.verify.pixels = 400;  // so that the certificates' own chance is less than that of the pixels held out
  CLI::App* sub = bench_app.add_subcommand("coverage", "How often certificates hold on frames they never saw");
  sub->add_option("--objects", measured.objects, "sphere, cylinder, bunny, dragon")
      ->delimiter(',')
      ->capture_default_str();
  sub->add_option("--shaders", measured.shaders, "Library shaders")->delimiter(',')->capture_default_str();
  sub->add_option("--size", measured.map_size, "Texels across a map")
      ->check(CLI::Range(16, 16384))
      ->capture_default_str();
  sub->add_option("--scenes", measured.scenes, "Held-out scenes for each object and shader")
      ->check(CLI::Range(1, 100000))
      ->capture_default_str();
  sub->add_option("--pixels", measured.verify.pixels, "Pixels for each minification that certificates are made from")
      ->check(CLI::Range(1, 1 << 20))
      ->capture_default_str();
  sub->add_option("--seed", measured.verify.seed, "Another number, other certificates and other scenes")
      ->capture_default_str();
  sub->add_option("--models", measured.models, "Folder of bunny_10k.obj and dragon_20k.obj")->capture_default_str();
  add_common_options(*sub, options->common);
  sub->footer("Example: redmap bench coverage --objects sphere --shaders noise --json coverage.json");
  sub->callback([options] { run(*options); });
}

}  // namespace redmap::cli
