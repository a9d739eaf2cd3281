#include "quality.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/error.h"
#include "bench_data.h"
#include "bench_scene.h"
#include "error_sums.h"
#include "reference.h"
#include "shader/shader.h"

namespace redmap::bench {

namespace {

// Samples of the shader itself, for the curve that equal-quality samples are read from.
constexpr int kCurveSpp[] = {1, 4, 9, 16, 36, 64, 144};
// Pixels of the interior that a case should have, and views that may be spent on them.
constexpr double kEnoughPixels = 20000;
constexpr int kMostViews = 8;
/// One row of the table to be.
struct MethodCase {
  Method method;
  Quality quality;
  int spp;
};

struct Case {
  std::vector<Scene> views;
  std::vector<ObjectData> data;
  std::vector<Image> references;
  std::vector<std::vector<PixelClass>> classes;
  double residual = 0;
};

Case make_case(const std::shared_ptr<const Surface>& surface, const std::shared_ptr<const Shader>& shader,
               const std::vector<ObjectData>& data, double minification, const QualityOptions& options) {
  Case result;
  result.data = data;
  ErrorSums between_halves;
  for (int view = 0; view < (options.views ? options.views : kMostViews); ++view) {
    if (!options.views && between_halves.interior_pixels() > kEnoughPixels) break;
    result.views.push_back(make_bench_scene(surface, shader, options.map_size, minification, view));
    result.classes.emplace_back();
    result.references.push_back(render_reference(result.views.back(), data, options.reference_spp, view,
                                                 result.classes.back(), between_halves));
  }
  result.residual = between_halves.interior() / 2;  // the mean of two halves has half their difference's deviation
  return result;
}

ErrorSums errors_of(const Case& c, const RenderOptions& options) {
  ErrorSums sums;
  Renderer renderer(c.views.front(), options, c.data);
  for (std::size_t view = 0; view < c.views.size(); ++view)
    sums.add(renderer.render(c.views[view], static_cast<int>(view)).image, c.references[view], c.classes[view]);
  return sums;
}

using Curve = std::vector<std::pair<double, double>>;  // samples, error

/// Samples at which `curve` reaches `error`, straight lines between logarithms, and past the ends too.
double equal_quality(const Curve& curve, double error) {
  std::size_t i = 1;
  while (i + 1 < curve.size() && curve[i].second > error) ++i;
  const double x0 = std::log(curve[i - 1].first), x1 = std::log(curve[i].first);
  const double y0 = std::log(curve[i - 1].second), y1 = std::log(curve[i].second);
  if (error <= 0 || y0 == y1) return std::numeric_limits<double>::infinity();
  return std::exp(x0 + (x1 - x0) * (std::log(error) - y0) / (y1 - y0));
}

Curve supersampling_curve(const Case& c) {
  Curve curve;
  for (int spp : kCurveSpp) {
    RenderOptions options;
    options.method = Method::kSupersample;
    options.spp = spp;
    curve.push_back({spp, std::max(errors_of(c, options).interior(), 1e-9)});
  }
  return curve;
}

RenderOptions options_of(const MethodCase& method) {
  RenderOptions options;
  options.method = method.method == Method::kOriginal ? Method::kSupersample : method.method;
  options.quality = method.quality;
  options.spp = method.spp;
  return options;
}

bool has_quality(Method method) { return method == Method::kMap || method == Method::kParameters; }

void measure_speed(const Case& c, const RenderOptions& options, int repeats, QualityRow& row) {
  Renderer renderer(c.views.front(), options, c.data);
  double pixels = 0;
  for (const Image& reference : c.references) pixels += static_cast<double>(reference.pixels());
  double best = std::numeric_limits<double>::infinity();
  RenderCounts counts;
  for (int repeat = 0; repeat < repeats; ++repeat) {
    double seconds = 0;
    counts = {};
    for (std::size_t view = 0; view < c.views.size(); ++view) {
      const RenderedFrame frame = renderer.render(c.views[view], static_cast<int>(view));
      seconds += frame.seconds;
      counts += frame.counts;
    }
    best = std::min(best, seconds);
  }
  row.seconds_per_frame = best / static_cast<double>(c.views.size());
  row.rays_per_pixel = static_cast<double>(counts.camera_rays) / pixels;
  row.shader_calls_per_pixel = static_cast<double>(counts.shader_calls) / pixels;
  row.lookups_per_pixel = static_cast<double>(counts.lookups) / pixels;
}

std::vector<MethodCase> methods_of(const QualityOptions& options, const Shader& shader) {
  std::vector<MethodCase> all{{Method::kOriginal, Quality::kDefault, 1},
                              {Method::kSupersample, Quality::kDefault, 4},
                              {Method::kSupersample, Quality::kDefault, 16},
                              {Method::kSupersample, Quality::kDefault, 64}};
  if (has_parameters(shader.info()))
    for (Quality quality : {Quality::kFast, Quality::kDefault}) all.push_back({Method::kParameters, quality, 0});
  all.push_back({Method::kPaper, Quality::kDefault, 0});
  for (Quality quality : {Quality::kFast, Quality::kBalanced, Quality::kDefault})
    all.push_back({Method::kMap, quality, 0});
  if (!options.methods.empty())
    std::erase_if(all, [&](const MethodCase& m) {
      const std::string name(kMethodNames[static_cast<int>(m.method)]);
      return std::find(options.methods.begin(), options.methods.end(), name) == options.methods.end();
    });
  return all;
}

void measure_case(const Case& c, const QualityRow& labels, const std::vector<MethodCase>& methods,
                  const QualityOptions& options, std::vector<QualityRow>& rows) {
  const Curve curve = supersampling_curve(c);
  const std::size_t first = rows.size();
  for (const MethodCase& method : methods) {
    QualityRow row = labels;
    row.method = kMethodNames[static_cast<int>(method.method)];
    if (has_quality(method.method)) row.quality = name_of(method.quality);
    row.spp = method.spp;
    const ErrorSums errors = errors_of(c, options_of(method));
    row.rmse_interior = errors.interior();
    row.rmse_interior_clamped = errors.interior_clamped();
    row.rmse_brightest_tenth = errors.brightest_tenth();
    row.rmse_seams = errors.seams(), row.rmse_silhouette = errors.silhouette();
    row.bias_interior = errors.bias(), row.rmse_95th_percentile = errors.percentile_95();
    row.equal_quality_spp = equal_quality(curve, row.rmse_interior);
    row.reference_residual = c.residual;
    measure_speed(c, options_of(method), options.repeats, row);
    rows.push_back(row);
  }
  if (options.flicker_frames < 2) return;
  std::vector<RenderOptions> renderers;
  for (const MethodCase& method : methods) renderers.push_back(options_of(method));
  const auto flicker = [&](double degrees) {
    return measure_flicker([&](int frame) { return turned(c.views.front(), degrees * frame); }, c.data, renderers,
                           options.flicker_frames, options.reference_spp);
  };
  const auto fast = flicker(kFastDegrees), slow = flicker(degrees_for_pixels(c.views.front(), kSlowPixels));
  for (std::size_t i = 0; i < methods.size(); ++i)
    rows[first + i].flicker = fast[i], rows[first + i].flicker_slow = slow[i];
}

}  // namespace

std::vector<std::string> quality_methods() { return {std::begin(kMethodNames), std::end(kMethodNames)}; }

std::vector<QualityRow> measure_quality(const QualityOptions& options) {
  const std::vector<std::string> shaders = options.shaders.empty() ? library_shader_names() : options.shaders;
  // Whatever is misspelt is found before hours are spent.
  for (const std::string& name : shaders) library_shader_info(name);
  for (const std::string& object : options.objects) make_bench_surface(object, options.models);
  std::vector<QualityRow> rows;
  const double total = static_cast<double>(options.objects.size() * shaders.size() * options.minifications.size());
  double done = 0;
  for (const std::string& object : options.objects) {
    const auto surface = make_bench_surface(object, options.models);
    for (const std::string& name : shaders) {
      const std::shared_ptr<const Shader> shader = make_library_shader(name);
      const std::vector<ObjectData> data{make_bench_data(*surface, *shader, options.map_size, options.cancelled)};
      for (double minification : options.minifications) {
        if (options.cancelled && options.cancelled()) throw Error("the bench was cancelled");
        if (options.progress) options.progress(done++ / total, object + " " + name);
        QualityRow labels;
        labels.object = object, labels.shader = name, labels.minification = minification;
        labels.basis = static_cast<int>(data.front().map->basis.size());
        measure_case(make_case(surface, shader, data, minification, options), labels, methods_of(options, *shader),
                     options, rows);
      }
    }
  }
  return rows;
}

}  // namespace redmap::bench
