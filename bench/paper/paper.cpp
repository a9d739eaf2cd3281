#include "paper.h"

#include <fmt/ranges.h>

#include <algorithm>
#include <chrono>
#include <cmath>

#include "base/error.h"
#include "figures.h"
#include "laboratory.h"
#include "quality/bench_scene.h"

namespace redmap::bench {

namespace {

struct KnownFigure {
  const char* id;
  Figure (*measure)(Laboratory&);
};
constexpr KnownFigure kFigures[] = {
    {"fig1", measure_fig1},       {"fig4", measure_fig4},        {"fig5", measure_fig5},
    {"fig6", measure_fig6},       {"fig7", measure_fig7},        {"fig8", measure_fig8},
    {"fig9", measure_fig9},       {"fig10", measure_fig10},      {"fig11", measure_fig11},
    {"curves", measure_curves},   {"flicker", measure_flickers}, {"analysis", measure_analysis},
    {"filters", measure_filters}, {"stages", measure_stages},
};

/// Whatever is misspelt or missing is found before minutes are spent.
std::vector<KnownFigure> chosen(const PaperOptions& options) {
  const auto names = paper_figures();
  for (const std::string& name : options.figures)
    if (std::find(names.begin(), names.end(), name) == names.end())
      throw Error("there is no figure '{}': expected one of {}", name, fmt::join(names, ", "));
  if (options.object.empty()) {
    for (const PaperTexture& texture : paper_textures()) make_bench_surface(texture.object, options.models);
  } else {
    make_bench_surface(options.object, options.models);
  }
  std::vector<KnownFigure> figures;
  for (const KnownFigure& figure : kFigures)
    if (options.figures.empty() || std::count(options.figures.begin(), options.figures.end(), figure.id))
      figures.push_back(figure);
  return figures;
}

}  // namespace

std::string text_of(const Value& value) {
  if (const auto* words = std::get_if<std::string>(&value)) return *words;
  const auto* number = std::get_if<double>(&value);
  if (!number) return "-";
  // Less than this is rounding.
  constexpr double kNil = 5e-7;
  const double size = std::abs(*number);
  if (size < kNil) return "0";
  if (std::isfinite(*number) && size >= 1000 && size < 1e6) return fmt::format("{:.0f}", *number);
  return fmt::format("{:.3g}", *number);
}

std::vector<std::string> paper_figures() {
  std::vector<std::string> names;
  for (const KnownFigure& figure : kFigures) names.emplace_back(figure.id);
  return names;
}

Report measure_paper(const PaperOptions& options) {
  const auto start = std::chrono::steady_clock::now();
  const std::vector<KnownFigure> figures = chosen(options);
  Laboratory laboratory(options);
  Report report;
  report.quick = options.quick, report.map_size = options.map_size;
  for (std::size_t i = 0; i < figures.size(); ++i) {
    laboratory.begin(figures[i].id, i, figures.size());
    report.figures.push_back(figures[i].measure(laboratory));
    report.figures.back().id = figures[i].id;
    laboratory.step(1);
    if (options.figure_done) options.figure_done(report.figures.back());
  }
  report.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return report;
}

}  // namespace redmap::bench
