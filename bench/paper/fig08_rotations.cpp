// Fig. 8: texture calls and seconds of 300-frame rotations.
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "figures.h"
#include "quality/bench_scene.h"

namespace redmap::bench {

namespace {

constexpr int kPaperFrames = 300;

/// The object so far away that 16 samples a pixel ask the shader as often as in the paper: its pixels are as many.
/// Frame 0 of 300; the minification it came to is returned too.
std::pair<Scene, double> scene_with_calls(const BakedTexture& texture, int map_size, double calls_16) {
  constexpr int kCorrections = 3, kSides = 6;
  double minification = 8;
  Scene scene = scene_of(texture, map_size, minification);
  for (int i = 0; i < kCorrections; ++i) {
    Renderer renderer(scene, samples_method(16).options, texture.data);
    double calls = 0;
    for (int side = 0; side < kSides; ++side)
      calls += static_cast<double>(renderer.render(turned(scene, side * 360.0 / kSides), side).counts.shader_calls);
    minification *= std::sqrt(calls / kSides / calls_16);
    scene = scene_of(texture, map_size, minification);
  }
  return {scene, minification};
}

/// Production shaders have no figures in the paper; they are shown as large as the stone bunny.
std::vector<PaperTexture> rotated_textures(bool quick) {
  std::vector<PaperTexture> textures;
  double calls = 0;
  for (const PaperTexture& texture : paper_textures()) {
    if (texture.paper_calls_16 == 0) continue;
    textures.push_back(texture);
    if (texture.shader == "stone") calls = texture.paper_calls_16;
  }
  for (const char* shader : {"layered_rock", "wood", "worn_paint"}) {
    PaperTexture production{std::string("Production cost: ") + shader, "bunny", shader};
    production.paper_calls_16 = calls;
    textures.push_back(production);
    if (quick) break;
  }
  return textures;
}

enum MethodIndex { kOne, kSixteen, kPaper, kFast, kBalanced, kMap };

/// Calls, seconds, and what they are worth.
std::vector<Table> make_tables() {
  return {{"calls",
           "Texture calls a frame",
           {{"texture", "texture"},
            {"minification", "texels a pixel"},
            {"paper_calls_16", "16 samples, paper"},
            {"calls_16", "here"},
            {"paper_calls_map", "map, paper"},
            {"calls_paper_method", "its way here"},
            {"calls_fast", "map, fast"},
            {"calls_balanced", "map, balanced"},
            {"calls_map", "map"}},
           {}},
          {"seconds",
           "Seconds of 300 frames",
           {{"texture", "texture"},
            {"paper_seconds_1", "1 sample, paper"},
            {"seconds_1", "here"},
            {"paper_seconds_16", "16 samples, paper"},
            {"seconds_16", "here"},
            {"paper_seconds_map", "map, paper"},
            {"seconds_paper_method", "its way here"},
            {"seconds_fast", "map, fast"},
            {"seconds_balanced", "map, balanced"},
            {"seconds_map", "map"}},
           {}},
          {"speed_and_error",
           "16 samples / map, and errors",
           {{"texture", "texture"},
            {"paper_ratio_16_over_map", "16 samples / map, paper"},
            {"ratio_16_over_paper_method", "/ its way here"},
            {"ratio_16_over_fast", "/ map, fast"},
            {"ratio_16_over_balanced", "/ map, balanced"},
            {"ratio_16_over_map", "/ map"},
            {"ratio_at_16_quality", "at their quality or better"},
            {"rmse_16", "RMSE, 16 samples"},
            {"rmse_paper_method", "its way here"},
            {"rmse_fast", "map, fast"},
            {"rmse_balanced", "map, balanced"},
            {"rmse_map", "map"},
            {"residual", "residual"}},
           {}}};
}

Value or_nothing(double value) { return value > 0 ? Value(value) : Value(); }

struct Rotation {
  double minification = 0;
  int frames = 0;
  std::vector<SequenceCost> costs;
  SequenceErrors errors;

  double seconds(int method) const { return costs[method].seconds * kPaperFrames / frames; }
  double calls(int method) const { return static_cast<double>(costs[method].counts.shader_calls) / frames; }
  double speed_up(int method) const { return costs[kSixteen].seconds / costs[method].seconds; }
  /// Of the fastest quality that is as good as 16 samples; 0 if none is.
  double speed_up_at_quality() const {
    double most = 0;
    for (const int method : {kFast, kBalanced, kMap})
      if (errors.rmse[method] <= errors.rmse[kSixteen]) most = std::max(most, speed_up(method));
    return most;
  }
};

void add_rows(const PaperTexture& paper, const Rotation& r, std::vector<Table>& tables) {
  const bool in_paper = paper.paper_seconds_1 > 0;
  tables[0].rows.push_back({paper.name, r.minification, in_paper ? Value(paper.paper_calls_16) : Value(),
                            r.calls(kSixteen), or_nothing(paper.paper_calls_map), r.calls(kPaper), r.calls(kFast),
                            r.calls(kBalanced), r.calls(kMap)});
  tables[1].rows.push_back({paper.name, or_nothing(paper.paper_seconds_1), r.seconds(kOne),
                            or_nothing(paper.paper_seconds_16), r.seconds(kSixteen),
                            or_nothing(paper.paper_seconds_map), r.seconds(kPaper), r.seconds(kFast),
                            r.seconds(kBalanced), r.seconds(kMap)});
  tables[2].rows.push_back({paper.name, in_paper ? Value(paper.paper_seconds_16 / paper.paper_seconds_map) : Value(),
                            r.speed_up(kPaper), r.speed_up(kFast), r.speed_up(kBalanced), r.speed_up(kMap),
                            or_nothing(r.speed_up_at_quality()), r.errors.rmse[kSixteen], r.errors.rmse[kPaper],
                            r.errors.rmse[kFast], r.errors.rmse[kBalanced], r.errors.rmse[kMap], r.errors.residual});
}

Rotation measure_rotation(Laboratory& laboratory, const PaperTexture& paper, const std::function<void(double)>& step) {
  const std::vector<NamedMethod> methods = compared_methods();
  const BakedTexture texture = laboratory.baked(paper.object, paper.shader);
  Rotation rotation;
  Scene scene;
  std::tie(scene, rotation.minification) =
      scene_with_calls(texture, laboratory.options().map_size, paper.paper_calls_16);
  rotation.frames = laboratory.samples(kPaperFrames, 30);
  const double degrees = 360.0 / rotation.frames;
  const auto scene_at = [&](int frame) { return turned(scene, degrees * frame); };
  rotation.costs = render_sequence(scene_at, rotation.frames, texture.data, methods, step);
  std::vector<int> frames;
  for (int i = 0; i < laboratory.samples(5, 2); ++i) frames.push_back(i * rotation.frames / 5);
  rotation.errors = measure_errors(scene_at, frames, texture.data, methods, laboratory.samples(1024, 256));
  return rotation;
}

std::string found(const std::vector<std::string>& slow) {
  return slow.empty() ? "all" : fmt::format("not: {}", fmt::join(slow, ", "));
}

}  // namespace

Figure measure_fig8(Laboratory& laboratory) {
  Figure figure;
  figure.title = "Fig. 8: rotations of 300 frames";
  figure.paper =
      "Texture calls a frame, and seconds of 300 frames at 1 sample a pixel, at 16, and by the map at one, on one "
      "Pentium 4. \"Visually of the same quality as 16 samples\", which is not measured there.";
  figure.ours =
      "The object is as far away as 16 samples a pixel take as many texture calls as in the paper. All methods render "
      "every frame in turn, all threads; a call is the radiance of the shader, or of a basis reflectance, under the "
      "one "
      "light. RMSE over the interior of some of the frames. \"At their quality or better\": of the fastest quality "
      "whose "
      "error is at or below that of 16 samples, nothing if there is none. Quick runs turn in larger steps, and their "
      "seconds are extrapolated to 300 frames.";
  figure.tables = make_tables();
  const std::vector<PaperTexture> textures = rotated_textures(laboratory.quick());
  std::vector<std::string> slow_textures, slow_production;
  for (std::size_t i = 0; i < textures.size(); ++i) {
    const auto count = static_cast<double>(textures.size()), index = static_cast<double>(i);
    const Rotation rotation =
        measure_rotation(laboratory, textures[i], [&](double part) { laboratory.step((index + part) / count); });
    const bool in_paper = textures[i].paper_seconds_1 > 0;
    constexpr double kAskedOfProduction = 6;
    const double asked = in_paper ? textures[i].paper_seconds_16 / textures[i].paper_seconds_map : kAskedOfProduction;
    if (rotation.speed_up_at_quality() <= asked)
      (in_paper ? slow_textures : slow_production)
          .push_back(fmt::format("{} {:.2f} (asked {:.2f})", textures[i].name, rotation.speed_up_at_quality(), asked));
    add_rows(textures[i], rotation, figure.tables);
  }
  figure.claims.push_back(
      {"16 samples / map, at their quality or better, above the paper's 1.7 to 2.5 for every texture",
       found(slow_textures), slow_textures.empty()});
  figure.claims.push_back(
      {"6 or more for shaders of production cost", found(slow_production), slow_production.empty()});
  return figure;
}

}  // namespace redmap::bench
