// Errors in motion: what the paper shows in its video.
#include <memory>

#include "figures.h"
#include "quality/bench_scene.h"
#include "quality/error_sums.h"
#include "quality/reference.h"

namespace redmap::bench {

namespace {

constexpr double kMinification = 16;
constexpr int kZoom = 4;

std::vector<NamedMethod> moving_methods() {
  return {samples_method(1), samples_method(16), paper_method(), map_method(Quality::kFast),
          map_method(Quality::kDefault)};
}

/// The frames of every method but the fast one, and of the reference.
void add_loops(const BakedTexture& texture, const Scene& scene, int frames, int reference_spp, Figure& figure) {
  const auto scene_at = [&](int frame) { return turned(scene, kFastDegrees * frame); };
  for (const NamedMethod& method : {samples_method(1), samples_method(16), map_method(Quality::kDefault)}) {
    Loop loop{texture.shader->info().name + ": " + method.label, {}, kZoom};
    Renderer renderer(scene, method.options, texture.data);
    for (int frame = 0; frame < frames; ++frame) loop.frames.push_back(renderer.render(scene_at(frame), frame).image);
    figure.loops.push_back(std::move(loop));
  }
  Loop reference{texture.shader->info().name + ": reference", {}, kZoom};
  std::vector<PixelClass> classes;
  ErrorSums between_halves;
  for (int frame = 0; frame < frames; ++frame)
    reference.frames.push_back(
        render_reference(scene_at(frame), texture.data, reference_spp, frame, classes, between_halves));
  figure.loops.push_back(std::move(reference));
}

}  // namespace

Figure measure_flickers(Laboratory& laboratory) {
  Figure figure;
  figure.title = "Flicker";
  figure.paper = "Its video: the map is of the quality of 16 samples a pixel, or better; no figures.";
  figure.ours =
      "Root mean square of (I_t - R_t) - (I_t-1 - R_t-1) over the interior at 16 texels a pixel: the object turns by "
      "one degree a frame, then so slowly that its nearest point moves .2 pixel a frame.";
  Table table{"flicker", "Flicker", {{"texture", "texture"}, {"motion", "motion"}}, {}};
  for (const NamedMethod& method : moving_methods()) table.columns.push_back({method.key, method.label});
  std::vector<RenderOptions> methods;
  for (const NamedMethod& method : moving_methods()) methods.push_back(method.options);
  const int frames = laboratory.samples(12, 4), spp = laboratory.samples(1024, 256);
  int below = 0, cases = 0;
  for (const PaperTexture& paper : paper_textures()) {
    laboratory.step(static_cast<double>(cases) / 2 / static_cast<double>(paper_textures().size()));
    const BakedTexture texture = laboratory.baked(paper.object, paper.shader);
    const Scene scene = scene_of(texture, laboratory.options().map_size, kMinification);
    const std::pair<const char*, double> motions[] = {{"1 degree a frame", kFastDegrees},
                                                      {".2 pixel a frame", degrees_for_pixels(scene, kSlowPixels)}};
    for (const auto& [motion, degrees] : motions) {
      const double each = degrees;
      const auto flicker =
          measure_flicker([&](int frame) { return turned(scene, each * frame); }, texture.data, methods, frames, spp);
      std::vector<Value> row{paper.name, motion};
      row.insert(row.end(), flicker.begin(), flicker.end());
      table.rows.push_back(std::move(row));
      below += flicker[4] <= flicker[1], ++cases;
    }
    if (paper.shader == "noise" || paper.shader == "scales")
      add_loops(texture, scene, laboratory.samples(24, 12), laboratory.samples(256, 64), figure);
  }
  figure.tables.push_back(std::move(table));
  figure.claims.push_back({"the map flickers no more than 16 samples",
                           text_of(static_cast<double>(below)) + " of " + text_of(static_cast<double>(cases)),
                           below == cases});
  return figure;
}

}  // namespace redmap::bench
