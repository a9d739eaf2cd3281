// `redmap bench normals`: bumpy, glossy surfaces by every method.
#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

#include "base/parallel.h"
#include "commands.h"
#include "common.h"
#include "machine.h"
#include "normals/cases.h"
#include "normals/normals.h"
#include "normals/summary.h"

namespace redmap::cli {

namespace {

struct Options {
  CommonOptions common;
  bench::NormalsOptions measured;
  bool full = false;
};

nlohmann::json or_null(const std::optional<double>& value) { return value ? nlohmann::json(*value) : nullptr; }

nlohmann::json to_json(const bench::NormalsRow& row) {
  return {{"object", row.object},
          {"bump", row.bump},
          {"gloss", row.gloss},
          {"minification", row.minification},
          {"method", row.method},
          {"quality", row.quality.empty() ? nlohmann::json(nullptr) : nlohmann::json(row.quality)},
          {"spp", row.spp ? nlohmann::json(row.spp) : nlohmann::json(nullptr)},
          {"relative_rmse", row.relative_rmse},
          {"flicker", or_null(row.flicker)},
          {"flicker_slow", or_null(row.flicker_slow)},
          {"shader_calls_per_lookup", row.shader_calls_per_lookup},
          {"microseconds_per_pixel", row.microseconds_per_pixel},
          {"supersampled_part", row.supersampled_part},
          {"reference_residual", row.reference_residual},
          {"basis", row.basis},
          {"pixels", row.pixels}};
}

nlohmann::json to_json(const bench::NormalsSummary& summary) {
  return {{"map_over_16spp_rmse", or_null(summary.map_over_16spp_rmse)},
          {"map_over_64spp_rmse", or_null(summary.map_over_64spp_rmse)},
          {"map_over_paper_rmse", or_null(summary.map_over_paper_rmse)},
          {"map_over_parameters_rmse", or_null(summary.map_over_parameters_rmse)},
          {"map_over_64spp_flicker", or_null(summary.map_over_64spp_flicker)},
          {"map_over_64spp_flicker_slow", or_null(summary.map_over_64spp_flicker_slow)},
          {"map_over_16spp_microseconds", or_null(summary.map_over_16spp_microseconds)},
          {"map_over_64spp_microseconds", or_null(summary.map_over_64spp_microseconds)},
          {"calls_single_basis", or_null(summary.calls_single_basis)},
          {"win_rate_against_16spp", or_null(summary.win_rate_against_16spp)},
          {"win_rate_against_64spp", or_null(summary.win_rate_against_64spp)},
          {"worst_over_64spp", or_null(summary.worst_over_64spp)},
          {"worst_case", summary.worst_case}};
}

std::vector<bench::NormalsRow> rows_at(const std::vector<bench::NormalsRow>& rows, double minification) {
  std::vector<bench::NormalsRow> some;
  std::copy_if(rows.begin(), rows.end(), std::back_inserter(some),
               [&](const bench::NormalsRow& row) { return row.minification == minification; });
  return some;
}

void print_row(const bench::NormalsRow& row) {
  const std::string label = fmt::format("{} {}", row.method, row.spp ? fmt::to_string(row.spp) : row.quality);
  fmt::print("{:<7} {:<7} {:<9} {:>3g}  {:<15} {:>8.4f} {:>8.4f} {:>6.2f} {:>6.1f} {:>8.3f} {:>8} {:>8}\n", row.object,
             row.bump, row.gloss, row.minification, label, row.relative_rmse, row.reference_residual,
             row.shader_calls_per_lookup, 100 * row.supersampled_part, row.microseconds_per_pixel,
             row.flicker ? fmt::format("{:.4f}", *row.flicker) : "-",
             row.flicker_slow ? fmt::format("{:.4f}", *row.flicker_slow) : "-");
}

void print_summary(const std::string& label, const bench::NormalsSummary& summary) {
  const auto number = [](const std::optional<double>& value) {
    return value ? fmt::format("{:.3f}", *value) : std::string("-");
  };
  fmt::print("{:<6} {:>7} {:>7} {:>7} {:>10} {:>8} {:>8} {:>6} {:>7} {:>7}  {}\n", label,
             number(summary.map_over_16spp_rmse), number(summary.map_over_64spp_rmse),
             number(summary.map_over_paper_rmse), number(summary.map_over_parameters_rmse),
             number(summary.map_over_64spp_flicker), number(summary.map_over_16spp_microseconds),
             number(summary.calls_single_basis), number(summary.win_rate_against_64spp),
             number(summary.worst_over_64spp), summary.worst_case);
}

/// The map's error and the like over those of other methods: all cases, then by distance.
nlohmann::json report_summary(const std::vector<bench::NormalsRow>& rows, const std::vector<double>& minifications) {
  fmt::print("\nmap over: {:>5} {:>7} {:>7} {:>10} {:>8} {:>8} {:>6} {:>7} {:>7}\n", "16 spp", "64 spp", "paper",
             "parameters", "flicker", "time/16", "calls", "wins/64", "worst");
  const bench::NormalsSummary all = bench::summarize(rows);
  print_summary("all", all);
  nlohmann::json json = to_json(all);
  json["by_minification"] = nlohmann::json::array();
  for (const double minification : minifications) {
    const bench::NormalsSummary some = bench::summarize(rows_at(rows, minification));
    print_summary(fmt::format("{:g}", minification), some);
    nlohmann::json entry = to_json(some);
    entry["minification"] = minification;
    json["by_minification"].push_back(entry);
  }
  return json;
}

void run(Options& options) {
  const ThreadLimit threads(static_cast<std::size_t>(options.common.threads));
  if (options.full) {
    options.measured.bumps = bench::bump_names(), options.measured.glosses = bench::gloss_names();
    options.measured.minifications = {4, 8, 16, 32, 64};
  }
  std::optional<Progress> progress(std::in_place, "measuring");
  options.measured.progress = [&](double part, const std::string&) { progress->update(part); };
  options.measured.cancelled = interrupted;
  const auto rows = bench::measure_normals(options.measured);
  progress.reset();

  fmt::print("{:<7} {:<7} {:<9} {:>3}  {:<15} {:>8} {:>8} {:>6} {:>6} {:>8} {:>8} {:>8}\n", "object", "bump", "gloss",
             "m", "method", "rel.rmse", "residual", "calls", "sup. %", "us/pixel", "flicker", "slow");
  nlohmann::json json{{"machine", machine_json()},
                      {"shader_microseconds", options.measured.shader_microseconds},
                      {"rows", nlohmann::json::array()}};
  for (const bench::NormalsRow& row : rows) print_row(row), json["rows"].push_back(to_json(row));
  json["summary"] = report_summary(rows, options.measured.minifications);
  write_json(options.common.json, json);
}

void add_case_options(CLI::App& sub, bench::NormalsOptions& measured) {
  sub.add_option("--objects", measured.objects, "plane, sphere, cylinder, bunny, dragon")
      ->delimiter(',')
      ->capture_default_str();
  sub.add_option("--bumps", measured.bumps)
      ->delimiter(',')
      ->check(CLI::IsMember(bench::bump_names()))
      ->capture_default_str();
  sub.add_option("--glosses", measured.glosses)
      ->delimiter(',')
      ->check(CLI::IsMember(bench::gloss_names()))
      ->capture_default_str();
  sub.add_option("--minifications", measured.minifications, "Texels across a pixel")
      ->delimiter(',')
      ->check(CLI::Range(1.0, 1024.0))
      ->capture_default_str();
  sub.add_option("--methods", measured.methods)
      ->delimiter(',')
      ->check(CLI::IsMember({"map", "paper", "parameters", "supersample"}))
      ->capture_default_str();
  sub.add_option("--spp", measured.spp, "Samples a pixel of supersample")
      ->delimiter(',')
      ->check(CLI::Range(1, 1 << 20))
      ->capture_default_str();
}

}  // namespace

void add_bench_normals(CLI::App& bench_app) {
  auto options = std::make_shared<Options>();
  bench::NormalsOptions& measured = options->measured;
  CLI::App* sub = bench_app.add_subcommand("normals", "Bumpy, glossy surfaces: objects x bumps x glosses x methods");
  add_case_options(*sub, measured);
  sub->add_flag("--full", options->full, "All bumps and glosses at 4, 8, 16, 32 and 64");
  sub->add_option("--size", measured.map_size, "Texels across a map")
      ->check(CLI::Range(16, 16384))
      ->capture_default_str();
  sub->add_option("--reference-spp", measured.reference_spp, "Samples a pixel of the reference, in two halves")
      ->check(CLI::Range(8, 1 << 20))
      ->capture_default_str();
  sub->add_option("--pixels", measured.largest, "Pixels a side of a view, at most")
      ->check(CLI::Range(8, 4096))
      ->capture_default_str();
  sub->add_option("--views", measured.views, "Views a case (as many as its error needs if not given)")
      ->check(CLI::Range(1, 1000));
  sub->add_option("--flicker-frames", measured.flicker_frames, "Frames of the two flicker sequences; 0: none")
      ->check(CLI::Range(0, 10000))
      ->capture_default_str();
  sub->add_option("--repeats", measured.repeats, "Times are the fastest of so many frames")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
  sub->add_option("--shader-cost", measured.shader_microseconds, "Microseconds a point that the shader takes, at least")
      ->check(CLI::Range(0.0, 10.0))
      ->capture_default_str();
  sub->add_option("--pictures", measured.pictures, "Folder for a picture of every case");
  sub->add_option("--models", measured.models, "Folder of bunny_10k.obj and dragon_20k.obj")->capture_default_str();
  add_common_options(*sub, options->common);
  sub->footer("Example: redmap bench normals --objects plane --bumps fbm.25 --json normals.json --pictures cases");
  sub->callback([options] { run(*options); });
}

}  // namespace redmap::cli
