// Fig. 4: a transparent and a bump-mapped object, rendered through their maps.
#include "figures.h"
#include "quality/bench_data.h"
#include "quality/reference.h"

namespace redmap::bench {

Figure measure_fig4(Laboratory& laboratory) {
  Figure figure;
  figure.title = "Fig. 4: transparent, and bump-mapped";
  figure.paper = "Pictures: a bunny that lets light through without refraction, and one with bumps. No figures.";
  figure.ours =
      "Both seen at 8 texels a pixel. RMSE over the interior, linear light, unclamped; residual: of the reference.";
  Table table{"errors",
              "RMSE against the reference",
              {{"texture", "texture"},
               {"basis", "k"},
               {"rmse_1", "1 sample"},
               {"rmse_16", "16 samples"},
               {"rmse_parameters", "averaged parameters"},
               {"rmse_paper", "map, the paper's way"},
               {"rmse_map_fast", "map, fast"},
               {"rmse_map", "map"},
               {"residual", "residual"}},
              {}};
  const std::vector<NamedMethod> methods{samples_method(1), samples_method(16),         parameters_method(),
                                         paper_method(),    map_method(Quality::kFast), map_method(Quality::kDefault)};
  const int spp = laboratory.samples(1024, 256);
  const int first_frame[] = {0};
  bool below = true;
  double done = 0;
  for (const char* name : {"transparent", kBump}) {
    laboratory.step(done++ / 2);
    const BakedTexture texture = laboratory.baked("bunny", name);
    const Scene scene = scene_of(texture, laboratory.options().map_size, 8);
    const SequenceErrors errors = measure_errors([&](int) { return scene; }, first_frame, texture.data, methods, spp);
    std::vector<Value> row{texture.shader->info().name, static_cast<double>(texture.map().basis.size())};
    row.insert(row.end(), errors.rmse.begin(), errors.rmse.end());
    row.emplace_back(errors.residual);
    table.rows.push_back(std::move(row));
    below = below && errors.rmse[5] <= errors.rmse[1];
    figure.sliders.push_back(compare_methods(texture.shader->info().name, scene, texture.data, spp, 3));
  }
  figure.tables.push_back(std::move(table));
  figure.claims.push_back(
      {"the map at or below the error of 16 samples", below ? "both" : "not both, see the table", below});
  return figure;
}

}  // namespace redmap::bench
