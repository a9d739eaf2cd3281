// Fig. 9: what the algorithm itself costs, with a shader that is white and costs nothing.
#include <fmt/format.h>

#include <cmath>

#include "base/error.h"
#include "figures.h"
#include "quality/bench_scene.h"

namespace redmap::bench {

namespace {

struct PaperRow {
  const char *model, *object;
  int basis;
  double triangles, seconds_1, seconds_16, seconds_map;
};
constexpr PaperRow kPaperRows[] = {{"Igea", "bunny", 2, 10000, 15.6, 117.7, 28.6},
                                   {"Igea", "bunny", 4, 10000, 15.6, 117.7, 28.8},
                                   {"Dragon", "dragon", 2, 20000, 24.1, 186.6, 42.1},
                                   {"Dragon", "dragon", 4, 20000, 24.1, 186.6, 42.5}};
constexpr double kMinification = 4, kPaperPixels = 1e6;

/// A map of `basis` reflectances whose weights vary as those of marble do, all of them white.
BakedTexture white_texture(Laboratory& laboratory, const std::string& object, int basis) {
  BakedTexture texture = laboratory.baked(object, "white");
  BakeOptions options;
  options.size = laboratory.options().map_size, options.max_basis = basis;
  const auto marble = make_library_shader("marble");
  ReductionMap map = bake(*texture.surface, *marble, options);
  const ReductionMap& white = texture.map();
  if (map.basis.size() != static_cast<std::size_t>(basis))
    throw Error("fig9: marble on {}: expected a basis of {}, found {}", object, basis, map.basis.size());
  map.shader = white.shader, map.shader_hash = white.shader_hash, map.parameters = white.parameters;
  map.lobes.assign(map.basis.size(), white.lobes.front());
  map.verdict = MapVerdict::kReduces, map.verdict_reason.clear();
  texture.data.front().map = std::make_shared<const ReductionMap>(std::move(map));
  return texture;
}

}  // namespace

Figure measure_fig9(Laboratory& laboratory) {
  Figure figure;
  figure.title = "Fig. 9: overhead with a white shader";
  figure.paper =
      "Seconds of 1 000 000 pixels with a shader that returns white, so that rays and the algorithm are all that is "
      "left. 1 sample / map: .54 to .57.";
  figure.ours =
      "The same at 4 texels a pixel, the object turning from frame to frame; pixels of the whole picture, all threads. "
      "The maps have the weights of marble, and k reflectances that are all white.";
  Table table{"overhead",
              "Seconds of 1 000 000 pixels",
              {{"model", "model"},
               {"triangles", "triangles"},
               {"basis", "k"},
               {"paper_seconds_1", "1 sample, paper"},
               {"seconds_1", "here"},
               {"paper_seconds_16", "16 samples, paper"},
               {"seconds_16", "here"},
               {"paper_seconds_map", "map, paper"},
               {"seconds_paper_method", "its way here"},
               {"seconds_fast", "map, fast"},
               {"seconds_balanced", "map, balanced"},
               {"seconds_map", "map"},
               {"paper_ratio", "1 sample / map, paper"},
               {"ratio_paper_method", "/ its way here"},
               {"ratio_fast", "/ map, fast"},
               {"ratio_balanced", "/ map, balanced"},
               {"ratio_map", "/ map"}},
              {}};
  const std::vector<NamedMethod> methods = compared_methods();
  double least = 1e9, done = 0;
  for (const PaperRow& paper : kPaperRows) {
    const BakedTexture texture = white_texture(laboratory, paper.object, paper.basis);
    const Scene scene = scene_of(texture, laboratory.options().map_size, kMinification);
    const double wanted = laboratory.quick() ? kPaperPixels / 2 : 4 * kPaperPixels;
    const int frames = static_cast<int>(std::ceil(wanted / (scene.camera.width * scene.camera.height)));
    const auto costs = render_sequence([&](int frame) { return turned(scene, frame); }, frames, texture.data, methods,
                                       [&](double part) { laboratory.step((done + part) / std::size(kPaperRows)); });
    ++done;
    const auto seconds = [&](int method) { return costs[method].seconds * kPaperPixels / costs[method].pixels; };
    const auto ratio = [&](int method) { return costs[0].seconds / costs[method].seconds; };
    least = std::min(least, ratio(3));
    table.rows.push_back({fmt::format("{} ({} here)", paper.model, paper.object), paper.triangles,
                          static_cast<double>(paper.basis), paper.seconds_1, seconds(0), paper.seconds_16, seconds(1),
                          paper.seconds_map, seconds(2), seconds(3), seconds(4), seconds(5),
                          paper.seconds_1 / paper.seconds_map, ratio(2), ratio(3), ratio(4), ratio(5)});
  }
  figure.tables.push_back(std::move(table));
  figure.claims.push_back(
      {"1 sample / map, fast: .65 or more (paper: .55)", "the least is " + text_of(least), least >= 0.65});
  return figure;
}

}  // namespace redmap::bench
