// Fig. 5: bytes of a map, by the paper's layout and by ours.
#include <fmt/format.h>

#include "figures.h"

namespace redmap::bench {

namespace {

/// The paper's sizes have one decimal.
constexpr double kHalfDigit = 0.05;

/// The paper's layout (section 4.6): a byte a weight, four for the mean normal, six for a normal distribution, and a
/// third more for the pyramid.
double paper_bytes(double texels, std::size_t basis, bool distributions) {
  return texels * 4 / 3 * static_cast<double>(basis + 4 + (distributions ? 6 : 0));
}

}  // namespace

Figure measure_fig5(Laboratory& laboratory) {
  Figure figure;
  figure.title = "Fig. 5: size of a map";
  figure.paper =
      "Megabytes of a map whose base has 1024 x 1024 texels, and their ratio to a mip-map of three bytes a texel "
      "(4.2 MB).";
  figure.ours =
      "Bytes that the texels of a map take in memory, padding and coverage included. \"Its layout\": what the paper's "
      "layout would take for the basis that its own selection (three reflectances of each 32 x 32 block) finds here.";
  Table table{"sizes",
              "Size in megabytes",
              {{"texture", "texture"},
               {"shader", "shader here"},
               {"paper_basis", "k, paper"},
               {"basis_by_paper_selection", "k, its selection here"},
               {"basis", "k, ours"},
               {"paper_megabytes", "MB, paper"},
               {"megabytes_in_paper_layout", "MB, its layout here"},
               {"megabytes", "MB, ours"},
               {"paper_ratio_to_mip_map", "/ mip-map, paper"},
               {"ratio_to_mip_map", "/ mip-map, ours"}},
              {}};
  const double texels = static_cast<double>(laboratory.options().map_size) * laboratory.options().map_size;
  const double mip_map = texels * 3 * 4 / 3;
  bool all_below = true;
  double done = 0;
  for (const PaperTexture& paper : paper_textures()) {
    laboratory.step(done++ / static_cast<double>(paper_textures().size()));
    const BakedTexture texture = laboratory.baked(paper.object, paper.shader);
    BakeOptions options;
    options.size = laboratory.options().map_size, options.selection = BasisSelection::kPaper;
    const std::size_t basis = bake(*texture.surface, *texture.shader, options).basis.size();
    const auto bytes = static_cast<double>(texel_bytes(texture.map()));
    const double in_layout = paper_bytes(texels, basis, texture.shader->info().perturbs_normals);
    all_below = all_below && bytes <= 1e6 * (paper.paper_megabytes + kHalfDigit);
    table.rows.push_back({paper.name, texture.shader->info().name, static_cast<double>(paper.paper_basis),
                          static_cast<double>(basis), static_cast<double>(texture.map().basis.size()),
                          paper.paper_megabytes, 1e-6 * in_layout, 1e-6 * bytes, 1e6 * paper.paper_megabytes / mip_map,
                          bytes / mip_map});
  }
  figure.tables.push_back(std::move(table));
  figure.claims.push_back({"at or below the paper's size, to its one decimal, for every texture",
                           all_below ? "every texture" : "not every texture, see the table", all_below});
  if (laboratory.options().map_size != 1024)
    figure.notes.push_back("The paper's sizes are those of 1024 x 1024 texels; this run had other maps.");
  return figure;
}

}  // namespace redmap::bench
