// Fig. 6: where the paper's rule supersamples a bumpy bunny, and how often.
#include <algorithm>

#include "figures.h"
#include "quality/bench_scene.h"
#include "render/decisions.h"

namespace redmap::bench {

namespace {

/// Samples of the shader that the paper's rule takes where it does not trust the mean normal (section 5.2).
constexpr double kPaperSamples = 16;
constexpr double kMinification = 8;

struct RuleUse {
  double samples_per_pixel = 0, part = 0;  ///< of the pixels of the object
};

/// Part of the object's pixels that are supersampled, and samples a pixel that come of it.
RuleUse measure_use(const std::function<Scene(int)>& scene_at, int frames, const std::vector<ObjectData>& data,
                    RenderOptions options) {
  options.decisions = true;
  Renderer renderer(scene_at(0), options, data);
  double pixels = 0, supersampled = 0;
  for (int frame = 0; frame < frames; ++frame) {
    const auto decisions = renderer.render(scene_at(frame), frame).decisions;
    pixels += static_cast<double>(
        std::count_if(decisions.begin(), decisions.end(), [](Decision d) { return d != Decision::kBackground; }));
    supersampled += static_cast<double>(std::count(decisions.begin(), decisions.end(), Decision::kSupersampled));
  }
  const double part = supersampled / pixels;
  return {1 + (kPaperSamples - 1) * part, part};
}

Table make_table() {
  return {"rule",
          "Samples a pixel by the paper's rule",
          {{"slope", "bumps"},
           {"paper_samples_per_pixel", "samples a pixel, paper"},
           {"samples_per_pixel", "its rule here"},
           {"supersampled_part", "part of the pixels supersampled"},
           {"map_supersampled_part", "the same, map"},
           {"rmse_paper", "RMSE, the paper's way"},
           {"rmse_map_fast", "RMSE, map, fast"},
           {"rmse_map", "RMSE, map"},
           {"rmse_16", "RMSE, 16 samples"}},
          {}};
}

Slider show_rule(Laboratory& laboratory) {
  const BakedTexture texture = laboratory.baked("bunny", kBump);
  const Scene scene = scene_of(texture, laboratory.options().map_size, kMinification);
  RenderOptions options = paper_method().options;
  options.decisions = true;
  RenderedFrame frame = Renderer(scene, options, texture.data).render(scene, 0);
  Slider slider{"The paper's rule on the bumpy bunny: red pixels are supersampled", {}, 3};
  slider.pictures.push_back({"decisions", paint_decisions(frame.decisions, frame.image.width, frame.image.height)});
  slider.pictures.push_back({"the paper's way", std::move(frame.image)});
  slider.pictures.push_back({"map", render_picture(scene, texture.data, map_method(Quality::kDefault).options)});
  return slider;
}

}  // namespace

Figure measure_fig6(Laboratory& laboratory) {
  Figure figure;
  figure.title = "Fig. 6: how often the paper's rule supersamples";
  figure.paper =
      "On the bumpy bunny, 1.6 samples a pixel on average over the animation: 16 where the half vector lies within "
      "2.5 standard deviations of the mean normal, one elsewhere.";
  figure.ours =
      "The same rule over a rotation in steps of one degree, on fractal bumps of three root mean square slopes under a "
      "Phong lobe of exponent 100; samples a pixel of the object, rays at silhouettes not counted, since the paper "
      "does "
      "not count them. The map integrates over normals instead: it never goes back to the shader.";
  Table table = make_table();
  const int frames = laboratory.samples(300, 20);
  const std::vector<int> error_frames = laboratory.quick() ? std::vector<int>{0} : std::vector<int>{0, 7, 13};
  double reached = 0, map_part = 0, done = 0;
  for (const char* bump : {"fbm.08", "fbm.25", "fbm.5"}) {
    laboratory.step(done++ / 3);
    const BakedTexture texture = laboratory.baked("bunny", bump);
    const Scene scene = scene_of(texture, laboratory.options().map_size, kMinification);
    const auto scene_at = [&](int frame) { return turned(scene, frame); };
    const RuleUse rule = measure_use(scene_at, frames, texture.data, paper_method().options);
    const RuleUse ours =
        measure_use(scene_at, std::min(frames, 20), texture.data, map_method(Quality::kDefault).options);
    const SequenceErrors errors =
        measure_errors(scene_at, error_frames, texture.data,
                       {paper_method(), map_method(Quality::kFast), map_method(Quality::kDefault), samples_method(16)},
                       laboratory.samples(1024, 256));
    if (bump == std::string_view(kBump)) reached = rule.samples_per_pixel;
    map_part = std::max(map_part, ours.part);
    table.rows.push_back({std::string(bump), bump == std::string_view(kBump) ? Value(1.6) : Value(),
                          rule.samples_per_pixel, rule.part, ours.part, errors.rmse[0], errors.rmse[1], errors.rmse[2],
                          errors.rmse[3]});
  }
  figure.tables.push_back(std::move(table));
  figure.claims.push_back({"1.6 samples a pixel or fewer under the paper's rule",
                           text_of(reached) + " with a root mean square slope of .08", reached <= 1.6});
  figure.claims.push_back(
      {"the map without any sample of the shader more", text_of(100 * map_part) + " % of the pixels", map_part == 0});
  figure.sliders.push_back(show_rule(laboratory));
  return figure;
}

}  // namespace redmap::bench
