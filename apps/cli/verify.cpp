// `redmap verify`: what the error of a scene's maps is, where, and why.
#include "verify/verify.h"

#include <fmt/ranges.h>

#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "base/error.h"
#include "base/parallel.h"
#include "certificate_text.h"
#include "commands.h"
#include "common.h"
#include "machine.h"
#include "map/map_file.h"
#include "object_data.h"
#include "scene/map_shader.h"
#include "scene/scene_file.h"
#include "verify/error_picture.h"

namespace redmap::cli {

namespace {

struct Options {
  std::string scene, picture, device, quality = "default";
  std::vector<std::string> objects, overrides;
  double max_error = 0, max_flip = 0;  ///< 0: not asked
  bool store = false;
  VerifyOptions verify;
  CommonOptions common;
};

nlohmann::json or_null(const std::optional<double>& value) { return value ? nlohmann::json(*value) : nullptr; }

nlohmann::json row_json(const ErrorRow& row, const char* of) {
  return {{of, row.of},
          {"pixels", row.pixels},
          {"rms_error", row.rms},
          {"mean_error", row.mean},
          {"bound", or_null(row.bound)},
          {"mean_flip", row.flip},
          {"flip_bound", or_null(row.flip_bound)},
          {"reference_residual", row.residual}};
}

nlohmann::json rows_json(const std::vector<ErrorRow>& rows, const char* of) {
  nlohmann::json json = nlohmann::json::array();
  for (const ErrorRow& row : rows) json.push_back(row_json(row, of));
  return json;
}

nlohmann::json pixel_json(const MeasuredPixel& measured) {
  const PixelCase& pixel = measured.pixel;
  const auto rgb = [](Rgb value) { return nlohmann::json{value.r, value.g, value.b}; };
  nlohmann::json json{{"minification", pixel.minification},
                      {"level", pixel.level},
                      {"anisotropy", pixel.anisotropy},
                      {"half_degrees", pixel.half_degrees},
                      {"uv", {pixel.uv.x, pixel.uv.y}},
                      {"position", {pixel.position.x, pixel.position.y, pixel.position.z}},
                      {"eye", {pixel.camera.position.x, pixel.camera.position.y, pixel.camera.position.z}},
                      {"to_light", {pixel.light.to_light.x, pixel.light.to_light.y, pixel.light.to_light.z}},
                      {"truth", rgb(measured.truth)},
                      {"map", rgb(measured.map)},
                      {"error", measured.error},
                      {"reference_residual", measured.residual},
                      {"flip", measured.flip},
                      {"seam", measured.on_seam}};
  if (!measured.by_map) return json;
  for (int s = 0; s < kStages; ++s) json["stages"][std::string(kStageNames[s])] = rgb(measured.stages[s]);
  return json;
}

nlohmann::json report_json(const VerifyReport& report) {
  nlohmann::json stages = nlohmann::json::object(), pixels = nlohmann::json::array();
  for (int s = 0; s < kStages; ++s)
    stages[std::string(kStageNames[s])] = {{"rms", report.shares[s].rms}, {"part", report.shares[s].part}};
  for (const MeasuredPixel& pixel : report.pixels) pixels.push_back(pixel_json(pixel));
  return {{"all", row_json(report.all, "of")},
          {"by_minification", rows_json(report.by_minification, "minification")},
          {"by_level", rows_json(report.by_level, "level")},
          {"stages", stages},
          {"certificate", certificate_json(report.certificate)},
          {"pixels", pixels}};
}

void print_rows(const std::vector<ErrorRow>& rows, const char* of, double coverage) {
  const auto number = [](const std::optional<double>& value) { return value ? fmt::format("{:.4f}", *value) : "-"; };
  const std::string bound = fmt::format("{:g} %", 100 * coverage);
  fmt::print("  {:>5} {:>7} {:>8} {:>8} {:>8} {:>8} {:>8} {:>8}\n", of, "pixels", "rms", "mean", bound, "flip", bound,
             "residual");
  for (const ErrorRow& row : rows)
    fmt::print("  {:>5g} {:>7} {:>8.4f} {:>8.4f} {:>8} {:>8.4f} {:>8} {:>8.4f}\n", row.of, row.pixels, row.rms,
               row.mean, number(row.bound), row.flip, number(row.flip_bound), row.residual);
}

void print_report(const Object& object, const VerifyReport& report, const VerifyOptions& options) {
  fmt::print("{}: {} on {}: rms error {:.4f} over {} pixels\n", object.name, object.shader->info().name,
             object.map_path.string(), report.all.rms, report.all.pixels);
  print_rows(report.by_minification, "m", options.coverage);
  print_rows(report.by_level, "level", options.coverage);
  fmt::print("  by stage:");
  for (int s = 0; s < kStages; ++s)
    fmt::print(" {} {:.4f} ({:.0f} %){}", kStageNames[s], report.shares[s].rms, 100 * report.shares[s].part,
               s + 1 < kStages ? "," : "\n");
  const Certificate::Place& worst = report.certificate.worst;
  fmt::print("  worst {:.4f} at uv {:.4f} {:.4f}, position {:.4g} {:.4g} {:.4g}, {:.3g} texels a pixel\n", worst.error,
             worst.uv.x, worst.uv.y, worst.position.x, worst.position.y, worst.position.z, worst.minification);
  if (!report.certificate.reason.empty())
    fmt::print("  most of it from {}: {}\n", report.certificate.weakest, report.certificate.reason);
}

/// What a bound breaks of the limit asked for; empty if it keeps it, or none was asked for.
std::string complaint(const char* what, double limit, const std::optional<double>& bound, double coverage) {
  if (limit <= 0) return {};
  if (!bound) return fmt::format("too few pixels to say anything about {}: ask for more --pixels", what);
  if (*bound <= limit) return {};
  return fmt::format("{:g} % of the pixels keep an {} of {:.4f}, over {:g}", 100 * coverage, what, *bound, limit);
}

/// Prints the verdict; what is wrong with the object's map, or nothing.
std::string judge(const Options& options, const Object& object, const VerifyReport& report) {
  const double coverage = options.verify.coverage;
  std::string wrong = complaint("error", options.max_error, largest_error_bound(report.by_minification), coverage);
  if (wrong.empty())
    wrong = complaint("FLIP error", options.max_flip, largest_flip_bound(report.by_minification), coverage);
  if (options.max_error > 0 || options.max_flip > 0) fmt::print("  verdict: {}\n", wrong.empty() ? "passes" : wrong);
  return wrong.empty() ? wrong : fmt::format("{}: {}", object.name, wrong);
}

/// `errors.png`, or with the object's name before the extension where there are several.
std::filesystem::path picture_path(const Options& options, const Object& object, bool several) {
  std::filesystem::path path = options.picture;
  if (several) path.replace_extension(fmt::format(".{}{}", object.name, path.extension().string()));
  return path;
}

VerifyReport verify_object(const Options& options, const Object& object, std::shared_ptr<const ReductionMap> map) {
  VerifyOptions verify_options = options.verify;
  verify_options.quality = quality_of(options.quality);
  verify_options.cancelled = interrupted;
  Progress progress("verify " + object.name);
  verify_options.progress = [&](double part) { progress.update(part); };
  VerifyReport report = verify(object, std::move(map), verify_options);
  stop_if_interrupted();
  return report;
}

/// The objects asked for, one for each map.
std::vector<Object> objects_to_verify(const Options& options, const SceneFile& file) {
  std::vector<Object> objects;
  if (options.objects.empty()) objects = file.at(1).objects;
  for (const std::string& name : options.objects)
    for (Object& object : file.objects(name)) objects.push_back(std::move(object));
  std::set<std::filesystem::path> seen;
  std::erase_if(objects, [&](const Object& object) { return !seen.insert(object.map_path).second; });
  return objects;
}

void verify_scene(const Options& options) {
  const ThreadLimit limit(static_cast<std::size_t>(options.common.threads));
  const SceneFile file = SceneFile::load(options.scene, options.overrides, options.device);
  print_remarks(file, options.common);
  const std::vector<Object> objects = objects_to_verify(options, file);
  nlohmann::json json{{"machine", machine_json()}, {"objects", nlohmann::json::array()}};
  std::vector<std::string> wrong;
  for (const Object& object : objects) {
    Scene alone;
    alone.objects.push_back(object);
    const std::vector<ObjectData> data = load_object_data(alone, Method::kMap);
    require_map_of(object, *data.front().map);
    const VerifyReport report = verify_object(options, object, data.front().map);
    print_report(object, report, options.verify);
    if (std::string complaint = judge(options, object, report); !complaint.empty()) wrong.push_back(complaint);
    if (!options.picture.empty())
      write_image(paint_errors(*data.front().map, report.pixels, *std::max({report.all.bound, std::optional(1e-6)})),
                  picture_path(options, object, objects.size() > 1));
    if (options.store) {
      ReductionMap certified = *data.front().map;
      certified.certificate = report.certificate;
      write_map(object.map_path, certified);
    }
    nlohmann::json entry = report_json(report);
    entry["object"] = object.name, entry["map"] = object.map_path.string();
    json["objects"].push_back(std::move(entry));
  }
  write_json(options.common.json, json);
  if (!wrong.empty()) throw Error("verify: {}", fmt::join(wrong, "; "));
}

}  // namespace

void add_verify_command(CLI::App& app) {
  CLI::App* sub = app.add_subcommand("verify", "Measure the error of a scene's maps, pixel by pixel, and say why");
  sub->footer(
      "Examples:\n"
      "  redmap verify scene.toml                             errors by minification and level, and their cause\n"
      "  redmap verify scene.toml --max-error 0.05 -o error.png   status 1 if more than 5 % of the pixels are off by "
      "more");
  auto options = std::make_shared<Options>();
  VerifyOptions& verify_options = options->verify;
  sub->add_option("scene", options->scene, "the scene's TOML file")->required();
  sub->add_option("--object", options->objects, "only this object (may be given several times)")
      ->allow_extra_args(false);
  sub->add_option("--max-error", options->max_error, "largest error that pixels may have, with the coverage asked for")
      ->check(CLI::PositiveNumber);
  sub->add_option("--max-flip", options->max_flip, "the same in units of FLIP")->check(CLI::PositiveNumber);
  sub->add_option("--coverage", verify_options.coverage, "part of the pixels that bounds hold for")
      ->check(CLI::Range(0.5, 0.999))
      ->capture_default_str();
  sub->add_option("--minifications", verify_options.minifications,
                  "texels across a pixel; default: .5 to a 32nd of the map, in octaves")
      ->delimiter(',')
      ->check(CLI::Range(0.01, 4096.0));
  sub->add_option("--pixels", verify_options.pixels, "random pixels for each minification")
      ->check(CLI::Range(1, 1 << 20))
      ->capture_default_str();
  sub->add_option("--spp", verify_options.spp, "samples of the shader itself in each")
      ->check(CLI::Range(2, 1 << 20))
      ->capture_default_str();
  sub->add_option("--seed", verify_options.seed, "another number, other pixels")->capture_default_str();
  sub->add_option("--quality", options->quality, "of the frames that the verdict is about")
      ->check(CLI::IsMember(quality_names()))
      ->capture_default_str();
  sub->add_flag("--store", options->store, "put the certificate into the map, for redmap inspect to show");
  add_override_option(*sub, options->overrides);
  add_device_option(*sub, options->device);
  sub->add_option("-o,--output", options->picture, "picture of the error over the atlas");
  add_common_options(*sub, options->common);
  sub->callback([options] { verify_scene(*options); });
}

}  // namespace redmap::cli
