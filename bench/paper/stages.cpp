// Sampling error apart from fit error, and both apart from filtering and from normals: the stages of a map's error.
#include "figures.h"
#include "verify/verify.h"

namespace redmap::bench {

Figure measure_stages(Laboratory& laboratory) {
  Figure figure;
  figure.title = "Sampling error apart from fit error";
  figure.paper = "Not told apart.";
  figure.ours =
      "Random pixels of 1 to 16 texels, each stage of the map in turn replaced by the truth (docs/verify.md). Fit: the "
      "basis in place of the shader. Texels: the base level in place of every point. Filter: the lookup in place of "
      "their average. Normals: a few normals and directions in place of all. In percent of the squared error; a stage "
      "below nil makes up for another.";
  Table table{"stages",
              "Where the error of a map comes from",
              {{"texture", "texture"},
               {"basis", "k"},
               {"rms_error", "RMS error"},
               {"fit", "fit"},
               {"texels", "texels"},
               {"filter", "filter"},
               {"normals", "normals"},
               {"fit_percent", "fit, %"},
               {"texels_percent", "texels, %"},
               {"filter_percent", "filter, %"},
               {"normals_percent", "normals, %"}},
              {}};
  VerifyOptions options;
  options.minifications = {1, 2, 4, 8, 16};
  options.pixels = laboratory.samples(200, 30), options.spp = laboratory.samples(1024, 256);
  options.cancelled = laboratory.options().cancelled;
  double done = 0;
  for (const PaperTexture& paper : paper_textures()) {
    laboratory.step(done++ / static_cast<double>(paper_textures().size()));
    const BakedTexture texture = laboratory.baked(paper.object, paper.shader);
    Object object;
    object.name = paper.name, object.surface = texture.surface, object.shader = texture.shader;
    object.map_size = laboratory.options().map_size;
    const VerifyReport report = verify(object, texture.data.front().map, options);
    std::vector<Value> row{paper.name, static_cast<double>(texture.map().basis.size()), report.all.rms};
    for (const StageShare& share : report.shares) row.emplace_back(share.rms);
    for (const StageShare& share : report.shares) row.emplace_back(100 * share.part);
    table.rows.push_back(std::move(row));
  }
  figure.tables.push_back(std::move(table));
  return figure;
}

}  // namespace redmap::bench
