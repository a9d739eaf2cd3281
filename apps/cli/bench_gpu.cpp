// redmap bench gpu: frames and bakes on a Vulkan device, how long and how good, and whether they are the CPU's.
#include <fmt/format.h>

#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

#include "base/parallel.h"
#include "commands.h"
#include "common.h"
#include "device/device.h"
#include "gpu/bake_rows.h"
#include "gpu/frame_times.h"
#include "gpu/parity.h"
#include "machine.h"
#include "quality/bench_scene.h"

namespace redmap::cli {

namespace {

struct BenchGpuOptions {
  CommonOptions common;
  std::string device;
  std::vector<std::string> parts{"rows", "bake", "parity"};
  bench::FrameTimeOptions frames;
  std::string parity_object = "sphere";
  bench::ParityOptions parity;
  bench::BakeRowOptions bake;
};

std::string method_name(const bench::FrameTimeRow& row) {
  return std::string(kMethodNames[static_cast<std::size_t>(row.method)]) + (row.draws_one_basis ? " one basis" : "");
}

nlohmann::json frame_rows(const BenchGpuOptions& options) {
  nlohmann::json json = nlohmann::json::array();
  fmt::print("{:<16} {:>6}  {:<14} {:>4} {:>10} {:>8}\n", "shader", "lights", "method", "spp", "ms/frame", "rmse");
  for (const bench::FrameTimeRow& row : bench::measure_frame_times(options.frames)) {
    fmt::print("{:<16} {:>6}  {:<14} {:>4} {:>10.2f} {:>8.4f}\n", row.shader, row.lights, method_name(row), row.spp,
               row.milliseconds_per_frame, row.rmse_interior);
    json.push_back({{"shader", row.shader},
                    {"lights", row.lights},
                    {"minification", options.frames.minification},
                    {"method", method_name(row)},
                    {"spp", row.spp},
                    {"milliseconds_per_frame", row.milliseconds_per_frame},
                    {"rmse_interior", row.rmse_interior}});
  }
  return json;
}

nlohmann::json bake_rows(const BenchGpuOptions& options) {
  nlohmann::json json = nlohmann::json::array();
  fmt::print("{:<18} {:>6} {:>8} {:>8} {:>6} {:>12} {:>8}\n", "shader", "size", "device s", "cpu s", "ratio",
             "mean weight", "flipped");
  for (const bench::BakeRow& row : bench::measure_bakes(options.bake)) {
    fmt::print("{:<18} {:>6} {:>8.3f} {:>8.3f} {:>6.2f} {:>12.7f} {:>8}\n", row.shader, row.size, row.gpu_seconds,
               row.cpu_seconds, row.gpu_seconds / row.cpu_seconds, row.difference.mean_weight, row.difference.flipped);
    json.push_back({{"shader", row.shader},
                    {"size", row.size},
                    {"gpu_seconds", row.gpu_seconds},
                    {"cpu_seconds", row.cpu_seconds},
                    {"mean_weight_difference", row.difference.mean_weight},
                    {"flipped_texels", row.difference.flipped}});
  }
  return json;
}

nlohmann::json parity_rows(const BenchGpuOptions& options) {
  nlohmann::json json = nlohmann::json::array();
  fmt::print("{:<18} {:>8} {:>9} {:>9}\n", "shader", "distance", "rmse", "largest");
  const auto surface = bench::make_bench_surface(options.parity_object, options.bake.models);
  for (const bench::ParityRow& row : bench::measure_parity(surface, options.parity)) {
    fmt::print("{:<18} {:>8.1f} {:>9.6f} {:>9.4f}\n", row.shader, row.distance, row.rmse, row.max_error);
    json.push_back({{"shader", row.shader}, {"distance", row.distance}, {"rmse", row.rmse}});
  }
  return json;
}

void run_bench_gpu(BenchGpuOptions& options) {
  const ThreadLimit threads(static_cast<std::size_t>(options.common.threads));
  const DeviceInfo device = Device::open(options.device)->info();
  options.frames.device = options.parity.device = options.bake.device = options.device;
  std::optional<Progress> progress(std::in_place, "measuring");
  options.frames.progress = options.parity.progress =
      options.bake.progress = [&](double part) { progress->update(part); };
  options.frames.cancelled = options.parity.cancelled = options.bake.cancelled = interrupted;
  nlohmann::json json{
      {"machine", machine_json()}, {"device", device.name}, {"driver", device.driver}, {"software", device.software}};
  fmt::print("{}{}\n", device.name, device.software ? ", software Vulkan" : "");
  for (const std::string& part : options.parts) {
    json[part] = part == "rows" ? frame_rows(options) : part == "bake" ? bake_rows(options) : parity_rows(options);
    stop_if_interrupted();
  }
  progress.reset();
  write_json(options.common.json, json);
}

}  // namespace

void add_bench_gpu(CLI::App& bench_app) {
  auto options = std::make_shared<BenchGpuOptions>();
  CLI::App* sub =
      bench_app.add_subcommand("gpu", "Frames and bakes on a Vulkan device: time, error, and agreement with the CPU");
  sub->add_option("--parts", options->parts, "What to measure: rows (frames), bake, parity")
      ->delimiter(',')
      ->check(CLI::IsMember({"rows", "bake", "parity"}))
      ->capture_default_str();
  sub->add_option("--shaders", options->frames.shaders, "Library shaders of the rows")
      ->delimiter(',')
      ->capture_default_str();
  sub->add_option("--lights", options->frames.lights, "Numbers of lights of the rows")
      ->delimiter(',')
      ->check(CLI::Range(1, 64))
      ->capture_default_str();
  sub->add_option("--minification", options->frames.minification, "Texels across a pixel in a timed frame")
      ->check(CLI::Range(0.1, 64.0))
      ->capture_default_str();
  sub->add_option("--width", options->frames.width, "Pixels of a timed frame")
      ->check(CLI::Range(16, 16384))
      ->capture_default_str();
  sub->add_option("--height", options->frames.height, "Pixels of a timed frame")
      ->check(CLI::Range(16, 16384))
      ->capture_default_str();
  sub->add_option("--frames", options->frames.frames, "Frames to take the median of")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
  sub->add_option("--parity-object", options->parity_object, "sphere, cylinder, bunny, dragon")->capture_default_str();
  sub->add_option("--parity-size", options->parity.map_size, "Texels across a map of the parity")
      ->check(CLI::Range(1, 16384))
      ->capture_default_str();
  sub->add_option("--parity-shaders", options->parity.shaders, "Library shaders of the parity (all if not given)")
      ->delimiter(',');
  sub->add_option("--bake-shaders", options->bake.shaders, "Library shaders to bake (all if not given)")
      ->delimiter(',');
  sub->add_option("--bake-size", options->bake.size, "Texels across a map that is baked both ways")
      ->check(CLI::Range(1, 16384))
      ->capture_default_str();
  sub->add_option("--bake-object", options->bake.object, "sphere, cylinder, bunny, dragon")->capture_default_str();
  sub->add_option("--models", options->bake.models, "Folder of bunny_10k.obj and dragon_20k.obj")
      ->capture_default_str();
  add_device_option(*sub, options->device);
  add_common_options(*sub, options->common);
  sub->footer("Example: redmap bench gpu --device 0 --json gpu.json");
  sub->callback([options] { run_bench_gpu(*options); });
}

}  // namespace redmap::cli
