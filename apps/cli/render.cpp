// redmap render: a scene to pictures, frame by frame, by any of the methods.
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <fstream>
#include <functional>
#include <memory>
#include <nlohmann/json.hpp>
#include <numeric>
#include <optional>

#include "base/atomic_file.h"
#include "base/error.h"
#include "base/hash.h"
#include "base/image.h"
#include "base/parallel.h"
#include "base/srgb.h"
#include "commands.h"
#include "common.h"
#include "device/device.h"
#include "gpu/device_renderer.h"
#include "object_data.h"
#include "render/closest_view.h"
#include "scene/fingerprint.h"
#include "scene/frame_spec.h"
#include "scene/scene_file.h"

namespace redmap::cli {

namespace {

// Raised whenever the same scene, map and settings would give another picture.
constexpr std::uint64_t kRendererVersion = 3;

struct RenderCommandOptions {
  CommonOptions common;
  std::string scene, output, device;
  std::string method = "map", quality = "default", show = "picture", frames;
  int spp = 0;
  std::uint64_t seed = 0;
  bool force = false, draws_one_basis = false;
  std::vector<std::string> overrides;
};

RenderOptions render_options(const RenderCommandOptions& options) {
  RenderOptions render;
  render.method = method_of(options.method);
  render.quality = quality_of(options.quality);
  render.spp = options.spp;
  render.seed = options.seed;
  render.decisions = options.show == "decisions";
  render.cancelled = interrupted;
  return render;
}

std::vector<int> frames_to_render(const RenderCommandOptions& options, const SceneFile& file) {
  if (options.frames.empty()) {
    std::vector<int> all(has_frame_number(options.output) ? file.frame_count() : 1);
    for (std::size_t i = 0; i < all.size(); ++i) all[i] = static_cast<int>(i) + 1;
    return all;
  }
  const std::vector<int> frames = parse_frames(options.frames);
  if (frames.back() > file.frame_count())
    throw Error("--frames {}: {} ends at frame {}", options.frames, options.scene, file.frame_count());
  if (frames.size() > 1 && !has_frame_number(options.output))
    throw Error("--output {}: {} frames need a name such as out.####.png", options.output, frames.size());
  return frames;
}

/// Decides, with the scene, what a frame looks like.
std::uint64_t settings_fingerprint(const RenderOptions& options, const Scene& scene) {
  std::uint64_t hash =
      hash64(kRendererVersion, static_cast<std::uint64_t>(options.method), static_cast<std::uint64_t>(options.quality));
  hash = hash64(hash, static_cast<std::uint64_t>(options.spp), options.seed);
  if (options.decisions) hash = hash64(hash, 1);
  for (const Object& object : scene.objects) {
    hash = hash64(hash, static_cast<std::uint64_t>(object.map_size));
    if (options.method != Method::kMap && options.method != Method::kPaper) continue;
    std::ifstream map(object.map_path, std::ios::binary);
    const std::string bytes{std::istreambuf_iterator<char>(map), {}};
    hash = hash_bytes(hash, bytes.data(), bytes.size());
  }
  return hash;
}

/// Beside every finished frame stands a hidden file that says what it was made of.
std::filesystem::path fingerprint_path(const std::filesystem::path& picture) {
  return picture.parent_path() / fmt::format(".{}.fingerprint", picture.filename().string());
}

std::string fingerprint_text(const std::filesystem::path& picture, std::uint64_t fingerprint) {
  return fmt::format("{:016x} {}\n", fingerprint, std::filesystem::file_size(picture));
}

bool is_finished(const std::filesystem::path& picture, std::uint64_t fingerprint) {
  std::ifstream file(fingerprint_path(picture));
  const std::string found{std::istreambuf_iterator<char>(file), {}};
  return !found.empty() && std::filesystem::exists(picture) && found == fingerprint_text(picture, fingerprint);
}

/// A frame that cannot be remembered is whole all the same: it is only rendered again.
void remember_finished(const std::filesystem::path& picture, std::uint64_t fingerprint) {
  try {
    write_file(fingerprint_path(picture), fingerprint_text(picture, fingerprint));
  } catch (const Error&) {
  }
}

using DecisionCounts = std::array<std::size_t, kDecisionCount>;

/// The decisions of a frame as colours; adds its pixels to `counts`.
Image painted(const RenderedFrame& frame, DecisionCounts& counts) {
  for (Decision decision : frame.decisions) ++counts[static_cast<std::size_t>(decision)];
  return paint_decisions(frame.decisions, frame.image.width, frame.image.height);
}

/// What the colours of `--show decisions` stand for, with the part of the pixels that each has.
void print_legend(const DecisionCounts& pixels) {
  const double total = static_cast<double>(std::accumulate(pixels.begin(), pixels.end(), std::size_t{0}));
  if (total == 0) return;
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    const auto& [label, color] = decision_legend(static_cast<Decision>(i));
    const auto byte = [](float linear) { return std::lround(255 * linear_to_srgb(linear)); };
    fmt::print("  #{:02x}{:02x}{:02x} {:>5.1f} %  {}\n", byte(color.r), byte(color.g), byte(color.b),
               100 * static_cast<double>(pixels[i]) / total, label);
  }
}

nlohmann::json frame_json(int frame, const std::string& path, const RenderedFrame& rendered) {
  const double pixels = static_cast<double>(rendered.image.pixels());
  const auto per_pixel = [&](std::uint64_t count) { return static_cast<double>(count) / pixels; };
  return {{"frame", frame},
          {"path", path},
          {"seconds", rendered.seconds},
          {"rays_per_pixel", per_pixel(rendered.counts.camera_rays)},
          {"shadow_rays_per_pixel", per_pixel(rendered.counts.shadow_rays)},
          {"shader_calls_per_pixel", per_pixel(rendered.counts.shader_calls)},
          {"lookups_per_pixel", per_pixel(rendered.counts.lookups)},
          {"supersampled_pixels", rendered.counts.supersampled_pixels}};
}

void report_maps(const Scene& scene, Method method, const std::vector<ObjectData>& data) {
  for (std::size_t i = 0; i < data.size(); ++i)
    if (is_supersampled(scene.objects[i], method, data[i]))
      fmt::print("object '{}' is supersampled: {}\n", scene.objects[i].name, data[i].map->verdict_reason);
}

using RenderFrame = std::function<RenderedFrame(const Scene&, int)>;

/// Frames on the CPU. `progress` is told the part of a frame that is done.
RenderFrame cpu_frames(const Scene& scene, RenderOptions render, const std::function<void(double)>& progress) {
  const std::vector<ObjectData> data = load_object_data(scene, render.method);
  report_maps(scene, render.method, data);
  render.progress = progress;
  const auto renderer = std::make_shared<Renderer>(scene, render, data);
  return [renderer](const Scene& moment, int frame) { return renderer->render(moment, frame); };
}

DeviceRenderOptions device_options(const RenderCommandOptions& options, const RenderOptions& render) {
  if (render.decisions) throw Error("--show decisions: expected no --device, found \"{}\"", options.device);
  const DeviceRenderOptions device{render.method, render.quality, render.spp, options.draws_one_basis};
  require_device_method(device);
  return device;
}

RenderFrame device_frames(const Scene& scene, const DeviceRenderOptions& options, const std::string& device) {
  const auto renderer =
      std::make_shared<DeviceRenderer>(Device::open(device), scene, options, load_object_data(scene, options.method));
  return [renderer](const Scene& moment, int frame) {
    RenderedFrame rendered;
    rendered.seconds = renderer->render(moment, frame);
    rendered.image = renderer->picture();
    return rendered;
  };
}

void run_render(const RenderCommandOptions& options) {
  const ThreadLimit threads(static_cast<std::size_t>(options.common.threads));
  SceneFile file = SceneFile::load(options.scene, options.overrides, options.device);
  print_remarks(file, options.common);
  // Maps know their size; averaged parameters get the size that a map would have.
  if (options.method == "parameters") settle_map_sizes(file, [] { return interrupted(); });
  const std::vector<int> frames = frames_to_render(options, file);
  const RenderOptions render = render_options(options);
  std::uint64_t settings = settings_fingerprint(render, file.at(frames.front()));
  if (!options.device.empty())
    settings = hash64(hash_bytes(settings, options.device.data(), options.device.size()), options.draws_one_basis);

  std::optional<DeviceRenderOptions> on_device;
  if (!options.device.empty()) on_device = device_options(options, render);

  RenderFrame render_frame;  // made once a frame really has to be rendered
  std::optional<Progress> progress(std::in_place, "rendering");
  nlohmann::json rows = nlohmann::json::array();
  std::size_t skipped = 0;
  double seconds = 0;
  DecisionCounts decisions{};
  for (std::size_t i = 0; i < frames.size(); ++i) {
    stop_if_interrupted();
    const Scene scene = file.at(frames[i]);
    const std::string path = frame_path(options.output, frames[i]);
    const std::uint64_t fingerprint = hash64(scene_fingerprint(scene), settings, static_cast<std::uint64_t>(frames[i]));
    if (!options.force && is_finished(path, fingerprint)) {
      ++skipped;
      continue;
    }
    if (!render_frame) {
      const auto tell = [&](double part) {
        progress->update((static_cast<double>(i) + part) / static_cast<double>(frames.size()));
      };
      render_frame = on_device ? device_frames(scene, *on_device, options.device) : cpu_frames(scene, render, tell);
    }
    const RenderedFrame rendered = render_frame(scene, frames[i]);
    stop_if_interrupted();
    write_image(render.decisions ? painted(rendered, decisions) : rendered.image, path);
    remember_finished(path, fingerprint);
    rows.push_back(frame_json(frames[i], path, rendered));
    seconds += rendered.seconds;
  }
  progress.reset();
  write_json(options.common.json, {{"method", options.method}, {"frames", rows}, {"skipped", skipped}});
  fmt::print("{} frame(s) by {} in {:.2f} s", rows.size(), options.method, seconds);
  fmt::print("{}\n", skipped ? fmt::format(", {} already finished", skipped) : "");
  if (render.decisions) print_legend(decisions);
}

}  // namespace

void add_render_command(CLI::App& app) {
  auto options = std::make_shared<RenderCommandOptions>();
  CLI::App* sub = app.add_subcommand("render", "Render a scene to pictures, by its maps or by another method");
  sub->add_option("scene", options->scene, "Scene file (TOML)")->required();
  sub->add_option("-o,--output", options->output, "Picture: out.exr, out.png, or out.####.png for frames")->required();
  sub->add_option(
         "--method", options->method,
         "map: reduction maps. original: the shader at the map's own rays. supersample: --spp jittered "
         "samples. parameters: mip-mapped averaged material parameters. paper: Van Horn and Turk to the letter")
      ->check(CLI::IsMember(method_names()))
      ->capture_default_str();
  sub->add_option("--quality", options->quality,
                  "Rays a pixel, more where needed: default (2 x 2), balanced (1, more also on bends and around "
                  "highlights) or fast (1)")
      ->check(CLI::IsMember(quality_names()))
      ->capture_default_str();
  sub->add_option("--show", options->show,
                  "picture, or decisions: how the value of each pixel was found, one flat colour each")
      ->check(CLI::IsMember({"picture", "decisions"}))
      ->capture_default_str();
  sub->add_option("--spp", options->spp, "Samples a pixel for supersample (16 if not given) and original")
      ->check(CLI::Range(1, 1 << 20));
  sub->add_option("--frames", options->frames, "Frames, for example 1-300,310,320-400:2 (all if not given)");
  sub->add_option("--seed", options->seed, "Seed of the jitter")->capture_default_str();
  sub->add_flag("--force", options->force, "Render again what is already finished");
  add_override_option(*sub, options->overrides);
  sub->add_flag("--draw-basis", options->draws_one_basis,
                "With --device: one basis reflectance a sample for all lights, drawn by its weight");
  sub->add_option("--device", options->device,
                  "Render on this Vulkan device: its number, or part of its name (redmap list devices)")
      ->type_name("DEVICE");
  add_common_options(*sub, options->common);
  sub->footer(
      "Frames whose scene, map and settings have not changed since they were finished are skipped.\n"
      "Example: redmap render scenes/sphere_noise.toml -o out.####.png --frames 1-24 --quality fast");
  sub->callback([options] { run_render(*options); });
}

}  // namespace redmap::cli
