// Fig. 7: four textures magnified, whole, and far away at 1, 16 and 100 samples a pixel and by the map, as one picture.
#include <algorithm>

#include "figures.h"
#include "quality/bench_scene.h"
#include "quality/label.h"
#include "quality/reference.h"

namespace redmap::bench {

namespace {

constexpr int kTextures = 4, kCell = 160, kLabel = 18;
/// Texels a pixel of the magnified, the whole and the far pictures.
constexpr double kMagnified = 0.25, kWhole = 2, kFar = 12;

/// `image`, enlarged by repeating pixels, in the middle of a cell.
void place_in_cell(const Image& image, Image& sheet, int column, int row) {
  const int zoom = std::max(1, kCell / std::max(image.width, image.height));
  const int width = std::min(kCell, image.width * zoom), height = std::min(kCell, image.height * zoom);
  const int from_x = (image.width * zoom - width) / 2, from_y = (image.height * zoom - height) / 2;
  const int to_x = column * kCell + (kCell - width) / 2, to_y = row * (kCell + kLabel) + (kCell - height) / 2;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      sheet.set_rgb(to_x + x, to_y + y, image.rgb((from_x + x) / zoom, (from_y + y) / zoom));
}

/// `image` brought down to what a cell holds, by averaging whole pixels.
Image shrunk(const Image& image) {
  const int step = (std::max(image.width, image.height) + kCell - 1) / kCell;
  Image small(image.width / step, image.height / step, 3);
  for (int y = 0; y < small.height; ++y)
    for (int x = 0; x < small.width; ++x) {
      Rgb sum;
      for (int j = 0; j < step; ++j)
        for (int i = 0; i < step; ++i) sum += image.rgb(x * step + i, y * step + j);
      small.set_rgb(x, y, sum * (1.0f / static_cast<float>(step * step)));
    }
  return small;
}

struct FarMethod {
  NamedMethod method;
  const char* key;
};
std::vector<FarMethod> far_methods() {
  return {{samples_method(1), "rmse_1"},
          {samples_method(16), "rmse_16"},
          {samples_method(100), "rmse_100"},
          {paper_method(), "rmse_paper"},
          {map_method(Quality::kFast), "rmse_map_fast"},
          {map_method(Quality::kDefault), "rmse_map"}};
}

/// A column of the sheet, and a row of the table.
std::vector<Value> add_texture(Laboratory& laboratory, const PaperTexture& paper, int column, Image& sheet,
                               Figure& figure) {
  const BakedTexture texture = laboratory.baked(paper.object, paper.shader);
  const int size = laboratory.options().map_size, spp = laboratory.samples(1024, 256);
  const auto fine = samples_method(laboratory.samples(64, 16)).options;
  place_in_cell(render_picture(scene_of(texture, size, kMagnified, 0, kCell), texture.data, fine), sheet, column, 0);
  place_in_cell(shrunk(render_picture(scene_of(texture, size, kWhole), texture.data, fine)), sheet, column, 1);
  const Scene scene = scene_of(texture, size, kFar);
  std::vector<NamedMethod> methods;
  for (const FarMethod& far : far_methods()) methods.push_back(far.method);
  int row = 2;
  for (const NamedMethod& method : methods)
    place_in_cell(render_picture(scene, texture.data, method.options), sheet, column, row++);
  const int first_frame[] = {0};
  const SequenceErrors errors = measure_errors([&](int) { return scene; }, first_frame, texture.data, methods, spp);
  figure.sliders.push_back(compare_methods(paper.name + ", as " + paper.shader, scene, texture.data, spp, 4));
  std::vector<Value> values{paper.name, paper.shader};
  values.insert(values.end(), errors.rmse.begin(), errors.rmse.end());
  values.emplace_back(errors.residual);
  return values;
}

void label_rows(Image& sheet) {
  std::vector<std::string> labels{"magnified", "whole"};
  for (const FarMethod& far : far_methods()) labels.push_back("far away: " + far.method.label);
  for (std::size_t row = 0; row < labels.size(); ++row)
    draw_label(sheet, 4, static_cast<int>(row) * (kCell + kLabel) + kCell + 5, labels[row], 1, {});
}

}  // namespace

Figure measure_fig7(Laboratory& laboratory) {
  Figure figure;
  figure.title = "Fig. 7: four textures, near and far";
  figure.paper =
      "Pictures: thresholded noise, scales, stone and marble magnified, whole, and far away at 1, 16 and 100 samples a "
      "pixel and by the map at one; enlarged without interpolation. No figures.";
  figure.ours = "The same picture, the far one at 12 texels a pixel, and the RMSE of each row of it.";
  Table table{"errors", "RMSE far away", {{"texture", "texture"}, {"shader", "shader here"}}, {}};
  for (const FarMethod& far : far_methods()) table.columns.push_back({far.key, far.method.label});
  table.columns.push_back({"residual", "residual"});
  Image sheet(kTextures * kCell, static_cast<int>(2 + far_methods().size()) * (kCell + kLabel), 3, 0.9f);
  int below_16 = 0;
  for (int column = 0; column < kTextures; ++column) {
    laboratory.step(static_cast<double>(column) / kTextures);
    table.rows.push_back(add_texture(laboratory, paper_textures()[column], column, sheet, figure));
    const std::vector<Value>& row = table.rows.back();
    below_16 += std::get<double>(row[7]) <= std::get<double>(row[3]);
  }
  label_rows(sheet);
  figure.pictures.push_back({"From left to right: noise, scales, stone, marble", std::move(sheet)});
  figure.tables.push_back(std::move(table));
  figure.claims.push_back({"the map at or below the error of 16 samples",
                           text_of(static_cast<double>(below_16)) + " of 4", below_16 == kTextures});
  return figure;
}

}  // namespace redmap::bench
