// Error against time, and against distance: the two curves that the paper's tables leave out.
#include <algorithm>
#include <map>

#include "figures.h"
#include "quality/quality.h"

namespace redmap::bench {

namespace {

constexpr double kNear = 8;  ///< texels a pixel, where time is compared

std::string label_of(const QualityRow& row) {
  if (row.method == "original") return "1 sample";
  if (row.method == "supersample") return text_of(static_cast<double>(row.spp)) + " samples";
  if (row.method == "paper") return paper_method().label;
  const std::string name = row.method == "parameters" ? parameters_method().label : row.method;
  return row.quality == "fast" ? name + ", fast" : name;
}

/// The same for a method in all plots. Samples that are one curve have the colour of 1 sample.
int colour_of(const std::string& label) {
  static const std::map<std::string, int> kColours = {{"1 sample", 0},           {"map, fast", 1},
                                                      {"64 samples", 2},         {"averaged parameters", 3},
                                                      {paper_method().label, 4}, {"averaged parameters, fast", 5},
                                                      {"16 samples", 6},         {"map", 7}};
  const auto found = kColours.find(label);
  return found == kColours.end() ? 0 : found->second;
}

/// Samples are one curve; every other method is a point.
Plot plot_time(const std::vector<QualityRow>& rows, const std::string& shader) {
  Plot plot{"time_" + shader, shader + ": error against time, 8 texels a pixel", "milliseconds a frame", "RMSE", {}};
  Series samples{"samples of the shader: 1, 4, 16, 64", {}, true, 0};
  for (const QualityRow& row : rows) {
    if (row.shader != shader || row.minification != kNear) continue;
    const Series::Point point{1e3 * row.seconds_per_frame, row.rmse_interior};
    if (row.method == "original" || row.method == "supersample")
      samples.points.push_back(point);
    else
      plot.series.push_back({label_of(row), {point}, false, colour_of(label_of(row))});
  }
  plot.series.insert(plot.series.begin(), std::move(samples));
  return plot;
}

Plot plot_distance(const std::vector<QualityRow>& rows, const std::string& shader) {
  Plot plot{"distance_" + shader, shader + ": error against distance", "texels a pixel", "RMSE", {}};
  for (const QualityRow& row : rows) {
    if (row.shader != shader) continue;
    const std::string label = label_of(row);
    if (label == "4 samples" || label == "averaged parameters, fast") continue;
    auto series =
        std::find_if(plot.series.begin(), plot.series.end(), [&](const Series& s) { return s.name == label; });
    if (series == plot.series.end())
      series = plot.series.insert(plot.series.end(), {label, {}, true, colour_of(label)});
    series->points.push_back({row.minification, row.rmse_interior});
  }
  return plot;
}

QualityOptions options_for(Laboratory& laboratory) {
  QualityOptions options;
  options.objects = {laboratory.options().object.empty() ? "bunny" : laboratory.options().object};
  options.shaders = {"noise", "scales", "stone", "marble", "two_tinted_satin", "wood"};
  options.minifications = {4, kNear, 16, 32};
  if (laboratory.quick()) options.shaders = {"scales", "marble"}, options.minifications = {4, kNear, 16};
  options.map_size = laboratory.options().map_size;
  options.reference_spp = laboratory.samples(1024, 256);
  options.views = 1;
  options.repeats = laboratory.samples(5, 2);
  options.models = laboratory.options().models;
  options.cancelled = laboratory.options().cancelled;
  options.progress = [&laboratory](double part, const std::string&) { laboratory.step(part); };
  return options;
}

}  // namespace

Figure measure_curves(Laboratory& laboratory) {
  Figure figure;
  figure.title = "Error against time and distance";
  figure.paper = "No such curves; its map is said to be of the quality of 16 samples.";
  figure.ours =
      "One view a case, RMSE over the interior, linear light, unclamped; the fastest of several frames. \"As good "
      "as\": the samples of the shader that reach the same error, read off their own curve.";
  const QualityOptions options = options_for(laboratory);
  const std::vector<QualityRow> rows = measure_quality(options);
  Table table{"errors",
              "Every method at every distance",
              {{"shader", "shader"},
               {"minification", "texels a pixel"},
               {"method", "method"},
               {"milliseconds", "ms a frame"},
               {"shader_calls_per_pixel", "calls a pixel"},
               {"rmse", "RMSE"},
               {"rmse_clamped", "clamped"},
               {"rmse_95th_percentile", "95th percentile"},
               {"equal_quality_samples", "as good as, samples"},
               {"residual", "residual"}},
              {}};
  for (const QualityRow& row : rows)
    table.rows.push_back({row.shader, row.minification, label_of(row), 1e3 * row.seconds_per_frame,
                          row.shader_calls_per_pixel, row.rmse_interior, row.rmse_interior_clamped,
                          row.rmse_95th_percentile, row.equal_quality_spp, row.reference_residual});
  figure.tables.push_back(std::move(table));
  for (const std::string& shader : options.shaders)
    figure.plots.push_back(plot_time(rows, shader)), figure.plots.push_back(plot_distance(rows, shader));
  return figure;
}

}  // namespace redmap::bench
