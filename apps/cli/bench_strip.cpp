// redmap bench strip: 1 sample a pixel | redmap | reference, side by side, with time and error.
#include <fmt/format.h>

#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

#include "base/error.h"
#include "base/image.h"
#include "base/parallel.h"
#include "commands.h"
#include "common.h"
#include "machine.h"
#include "object_data.h"
#include "quality/strip.h"
#include "scene/scene_file.h"

namespace redmap::cli {

namespace {

struct BenchStripOptions {
  CommonOptions common;
  std::string scene, output;
  std::vector<std::string> overrides;
  int frame = 1;
  std::vector<int> inset;
  bench::StripOptions strip;
};

void check_inset(const bench::StripOptions& strip, const Camera& camera) {
  if (strip.inset_x < 0 || strip.inset_y < 0 || strip.inset_width < 1 || strip.inset_height < 1 ||
      strip.inset_x > camera.width - strip.inset_width || strip.inset_y > camera.height - strip.inset_height)
    throw Error("--inset {},{},{},{}: expected a part of the {} x {} picture", strip.inset_x, strip.inset_y,
                strip.inset_width, strip.inset_height, camera.width, camera.height);
  if (strip.inset_width * strip.inset_zoom + 8 > camera.width ||
      strip.inset_height * strip.inset_zoom + 8 > camera.height)
    throw Error("--inset: {} times enlarged it does not fit the picture", strip.inset_zoom);
}

void run_bench_strip(BenchStripOptions& options) {
  const ThreadLimit threads(static_cast<std::size_t>(options.common.threads));
  const SceneFile file = SceneFile::load(options.scene, options.overrides);
  const Scene scene = file.at(options.frame);
  if (options.inset.size() == 4) {
    options.strip.inset_x = options.inset[0], options.strip.inset_y = options.inset[1];
    options.strip.inset_width = options.inset[2], options.strip.inset_height = options.inset[3];
  }
  check_inset(options.strip, scene.camera);
  std::optional<Progress> progress(std::in_place, "rendering the strip");
  options.strip.progress = [&](double part) { progress->update(part); };
  options.strip.cancelled = interrupted;
  const auto panels = bench::render_strip(scene, load_object_data(scene, Method::kMap), options.strip);
  progress.reset();
  stop_if_interrupted();
  write_image(bench::compose_strip(panels, options.strip), options.output);
  nlohmann::json json{{"machine", machine_json()}, {"panels", nlohmann::json::array()}};
  for (const bench::StripPanel& panel : panels) {
    fmt::print("{:<24} {:8.3f} s   RMSE {:.4f}\n", panel.label, panel.seconds, panel.rmse);
    json["panels"].push_back({{"label", panel.label}, {"seconds", panel.seconds}, {"rmse", panel.rmse}});
  }
  write_json(options.common.json, json);
}

}  // namespace

void add_bench_strip(CLI::App& bench_app) {
  auto options = std::make_shared<BenchStripOptions>();
  CLI::App* sub =
      bench_app.add_subcommand("strip", "1 sample a pixel | redmap | reference, with time and error, as a PNG");
  sub->add_option("scene", options->scene, "Scene file (TOML), baked")->required();
  sub->add_option("-o,--output", options->output, "Picture to write")->required();
  sub->add_option("--frame", options->frame, "Frame of the scene")->capture_default_str();
  sub->add_option("--inset", options->inset, "What the inset enlarges: x,y,width,height in pixels")
      ->delimiter(',')
      ->expected(4);
  sub->add_option("--zoom", options->strip.inset_zoom, "How often")->check(CLI::Range(1, 64))->capture_default_str();
  sub->add_option("--reference-spp", options->strip.reference_spp, "Samples a pixel of the reference")
      ->check(CLI::Range(8, 1 << 20))
      ->capture_default_str();
  add_override_option(*sub, options->overrides);
  add_common_options(*sub, options->common);
  sub->footer("Example: redmap bench strip scenes/strip.toml -o strip.png --inset 300,90,60,40");
  sub->callback([options] { run_bench_strip(*options); });
}

}  // namespace redmap::cli
