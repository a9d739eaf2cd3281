// redmap bench: the measurements behind every figure, as tables for people and JSON for scripts.
#include <fmt/format.h>

#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <thread>

#include "base/parallel.h"
#include "commands.h"
#include "common.h"
#include "machine.h"
#include "object_data.h"
#include "quality/quality.h"

namespace redmap::cli {

namespace {

struct BenchQualityOptions {
  CommonOptions common;
  bench::QualityOptions quality;
};

nlohmann::json number_or_null(const std::optional<double>& value) { return value ? nlohmann::json(*value) : nullptr; }

nlohmann::json row_json(const bench::QualityRow& row) {
  return {{"object", row.object},
          {"shader", row.shader},
          {"minification", row.minification},
          {"method", row.method},
          {"quality", row.quality.empty() ? nlohmann::json(nullptr) : nlohmann::json(row.quality)},
          {"spp", row.spp ? nlohmann::json(row.spp) : nlohmann::json(nullptr)},
          {"seconds_per_frame", row.seconds_per_frame},
          {"rays_per_pixel", row.rays_per_pixel},
          {"shader_calls_per_pixel", row.shader_calls_per_pixel},
          {"lookups_per_pixel", row.lookups_per_pixel},
          {"rmse_interior", row.rmse_interior},
          {"rmse_interior_clamped", row.rmse_interior_clamped},
          {"rmse_brightest_tenth", row.rmse_brightest_tenth},
          {"rmse_95th_percentile", row.rmse_95th_percentile},
          {"rmse_seams", row.rmse_seams},
          {"rmse_silhouette", row.rmse_silhouette},
          {"bias_interior", row.bias_interior},
          {"equal_quality_spp", row.equal_quality_spp},
          {"flicker", number_or_null(row.flicker)},
          {"flicker_slow", number_or_null(row.flicker_slow)},
          {"reference_residual", row.reference_residual},
          {"basis", row.basis}};
}

std::string method_label(const bench::QualityRow& row) {
  if (!row.quality.empty()) return fmt::format("{} {}", row.method, row.quality);
  return row.spp ? fmt::format("{} {}", row.method, row.spp) : row.method;
}

void print_table(const std::vector<bench::QualityRow>& rows) {
  fmt::print("{:<7} {:<16} {:>2} {:>3}  {:<18} {:>9} {:>6} {:>8} {:>8} {:>8} {:>8} {:>7} {:>8} {:>8}\n", "object",
             "shader", "k", "m", "method", "ms/frame", "rays", "rmse", "clamped", "seams", "silhou.", "eq spp",
             "flicker", "slow");
  for (const bench::QualityRow& row : rows)
    fmt::print(
        "{:<7} {:<16} {:>2} {:>3.0f}  {:<18} {:>9.2f} {:>6.2f} {:>8.4f} {:>8.4f} {:>8.4f} {:>8.4f} {:>7.1f} {:>8} "
        "{:>8}\n",
        row.object, row.shader, row.basis, row.minification, method_label(row), 1e3 * row.seconds_per_frame,
        row.rays_per_pixel, row.rmse_interior, row.rmse_interior_clamped, row.rmse_seams, row.rmse_silhouette,
        row.equal_quality_spp, row.flicker ? fmt::format("{:.4f}", *row.flicker) : "-",
        row.flicker_slow ? fmt::format("{:.4f}", *row.flicker_slow) : "-");
}

void run_bench_quality(BenchQualityOptions& options) {
  const ThreadLimit threads(static_cast<std::size_t>(options.common.threads));
  std::optional<Progress> progress(std::in_place, "measuring");
  options.quality.progress = [&](double part, const std::string&) { progress->update(part); };
  options.quality.cancelled = interrupted;
  const auto rows = bench::measure_quality(options.quality);
  progress.reset();
  print_table(rows);
  nlohmann::json json{{"machine", machine_json()}, {"rows", nlohmann::json::array()}};
  for (const bench::QualityRow& row : rows) json["rows"].push_back(row_json(row));
  write_json(options.common.json, json);
}

}  // namespace

void add_bench_command(CLI::App& app) {
  CLI::App* bench_app = app.add_subcommand("bench", "Measure methods against each other");
  bench_app->require_subcommand(1);
  add_bench_strip(*bench_app);
  add_bench_atlas(*bench_app);
  add_bench_shading_normals(*bench_app);
  add_bench_normals(*bench_app);
  add_bench_gpu(*bench_app);
  add_bench_export(*bench_app);
  add_bench_coverage(*bench_app);
  add_bench_paper(*bench_app);
  auto options = std::make_shared<BenchQualityOptions>();
  bench::QualityOptions& quality = options->quality;
  CLI::App* sub =
      bench_app->add_subcommand("quality", "Error, time and flicker: objects x shaders x minifications x methods");
  sub->add_option("--objects", quality.objects, "sphere, cylinder, bunny, dragon")
      ->delimiter(',')
      ->capture_default_str();
  sub->add_option("--shaders", quality.shaders, "Library shaders (all if not given)")->delimiter(',');
  sub->add_option("--minifications", quality.minifications, "Texels across a pixel")
      ->delimiter(',')
      ->check(CLI::Range(0.05, 4096.0))
      ->capture_default_str();
  sub->add_option("--methods", quality.methods, "original, supersample, parameters, paper, map (all if not given)")
      ->delimiter(',')
      ->check(CLI::IsMember(bench::quality_methods()));
  sub->add_option("--size", quality.map_size, "Texels across a map")
      ->check(CLI::Range(1, 16384))
      ->capture_default_str();
  sub->add_option("--reference-spp", quality.reference_spp, "Samples a pixel of the reference, in two halves")
      ->check(CLI::Range(8, 1 << 20))
      ->capture_default_str();
  sub->add_option("--views", quality.views, "Views a case (as many as its error needs if not given)")
      ->check(CLI::Range(1, 1000));
  sub->add_option("--flicker-frames", quality.flicker_frames, "Frames of the two flicker sequences; 0: none")
      ->check(CLI::Range(0, 10000))
      ->capture_default_str();
  sub->add_option("--models", quality.models, "Folder of bunny_10k.obj and dragon_20k.obj")->capture_default_str();
  add_common_options(*sub, options->common);
  sub->footer(
      "Example: redmap bench quality --objects sphere --shaders noise,marble --minifications 4,8 --json q.json");
  sub->callback([options] { run_bench_quality(*options); });
}

}  // namespace redmap::cli
