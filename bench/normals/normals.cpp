#include "normals.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <limits>
#include <memory>

#include "bake/bake.h"
#include "bake/baselines.h"
#include "base/error.h"
#include "cases.h"
#include "pictures.h"
#include "quality/bench_scene.h"
#include "quality/reference.h"

namespace redmap::bench {

namespace {

// Pixels of the interior that a case should have, and views that may be spent on them.
constexpr double kEnoughPixels = 2000;
constexpr int kMostViews = 8;

struct MethodCase {
  std::string name, quality;
  RenderOptions options;
  double lookups_per_pixel = 1;
};

std::vector<MethodCase> methods_of(const NormalsOptions& options) {
  std::vector<MethodCase> methods;
  const auto add = [&](Method method, const char* quality, int spp, double lookups) {
    const std::string name(kMethodNames[static_cast<int>(method)]);
    if (std::count(options.methods.begin(), options.methods.end(), name) == 0) return;
    MethodCase& added = methods.emplace_back(MethodCase{name, quality, {}, lookups});
    added.options.method = method, added.options.spp = spp;
    if (*quality) added.options.quality = quality_of(quality);
  };
  for (int spp : options.spp) add(Method::kSupersample, "", spp, 1);
  add(Method::kParameters, "default", 0, 4);
  add(Method::kPaper, "", 0, 1);
  add(Method::kMap, "fast", 0, 1);
  add(Method::kMap, "balanced", 0, 1);
  add(Method::kMap, "default", 0, 4);
  return methods;
}

/// Views of one case with what they should look like.
struct Views {
  std::vector<Scene> scenes;
  std::vector<Image> references;
  std::vector<std::vector<PixelClass>> classes;
  double object_pixels = 0, pixels = 0;
  ErrorSums between_halves;
};

Views make_views(const NormalsRow& labels, const std::shared_ptr<const Surface>& surface,
                 const std::shared_ptr<const Shader>& shader, const std::vector<ObjectData>& data,
                 const NormalsOptions& options) {
  Views views;
  for (int view = 0; view < (options.views ? options.views : kMostViews); ++view) {
    if (!options.views && views.between_halves.interior_pixels() > kEnoughPixels) break;
    views.scenes.push_back(
        make_bumpy_scene(labels.object, surface, shader, options.map_size, labels.minification, view, options.largest));
    views.classes.emplace_back();
    views.references.push_back(render_reference(views.scenes.back(), data, options.reference_spp, view,
                                                views.classes.back(), views.between_halves));
    const auto& classes = views.classes.back();
    views.pixels += static_cast<double>(classes.size());
    views.object_pixels +=
        static_cast<double>(classes.size() - std::count(classes.begin(), classes.end(), PixelClass::kBackground));
  }
  if (views.between_halves.interior_pixels() == 0)
    throw Error("{} {} {} at {}: no interior pixels", labels.object, labels.bump, labels.gloss, labels.minification);
  return views;
}

/// Renders all views `repeats` times; `images` are those of the last time.
void measure_method(const Views& views, const std::vector<ObjectData>& data, const MethodCase& method, int repeats,
                    std::vector<Image>& images, NormalsRow& row) {
  Renderer renderer(views.scenes.front(), method.options, data);
  ErrorSums errors;
  RenderCounts counts;
  double best = std::numeric_limits<double>::infinity();
  for (int repeat = 0; repeat < repeats; ++repeat) {
    double seconds = 0;
    counts = {}, images.clear();
    for (std::size_t view = 0; view < views.scenes.size(); ++view) {
      RenderedFrame frame = renderer.render(views.scenes[view], static_cast<int>(view));
      seconds += frame.seconds, counts += frame.counts;
      images.push_back(std::move(frame.image));
    }
    best = std::min(best, seconds);
  }
  for (std::size_t view = 0; view < images.size(); ++view)
    errors.add(images[view], views.references[view], views.classes[view]);
  row.relative_rmse = errors.interior() / errors.mean_reference();
  row.reference_residual = views.between_halves.interior() / 2 / errors.mean_reference();
  row.pixels = errors.interior_pixels();
  // Maps count theirs, those of rays at silhouettes too.
  const double lookups = method.options.method == Method::kMap ? static_cast<double>(counts.lookups)
                                                               : views.object_pixels * method.lookups_per_pixel;
  row.shader_calls_per_lookup = static_cast<double>(counts.shader_calls) / lookups;
  row.supersampled_part = static_cast<double>(counts.supersampled_pixels) / views.object_pixels;
  row.microseconds_per_pixel = 1e6 * best / views.pixels;
}

/// `rows` are those of one case, in the order of `methods`.
void add_flicker(const Views& views, const std::vector<ObjectData>& data, const std::vector<MethodCase>& methods,
                 const NormalsOptions& options, std::span<NormalsRow> rows) {
  std::vector<RenderOptions> renderers;
  for (const MethodCase& method : methods) renderers.push_back(method.options);
  const double mean = views.between_halves.mean_reference();
  const auto measure = [&](double degrees) {
    return measure_flicker([&](int frame) { return turned(views.scenes.front(), degrees * frame); }, data, renderers,
                           options.flicker_frames, options.reference_spp);
  };
  const auto fast = measure(kFastDegrees), slow = measure(degrees_for_pixels(views.scenes.front(), kSlowPixels));
  for (std::size_t i = 0; i < rows.size(); ++i) rows[i].flicker = fast[i] / mean, rows[i].flicker_slow = slow[i] / mean;
}

/// Measures one case, its labels in `labels`.
void measure_case(const NormalsRow& labels, const Views& views, const std::vector<ObjectData>& data,
                  const NormalsOptions& options, std::vector<NormalsRow>& rows) {
  const std::vector<MethodCase> methods = methods_of(options);
  const std::size_t first = rows.size();
  std::vector<CasePicture> pictures{{"reference", views.references.front()}};
  for (const MethodCase& method : methods) {
    NormalsRow row = labels;
    row.method = method.name, row.quality = method.quality;
    row.spp = method.options.spp;
    std::vector<Image> images;
    measure_method(views, data, method, options.repeats, images, row);
    pictures.push_back({fmt::format("{} {} {:.4f}", method.name, row.spp ? fmt::to_string(row.spp) : method.quality,
                                    row.relative_rmse),
                        std::move(images.front())});
    rows.push_back(std::move(row));
  }
  if (options.flicker_frames > 1) add_flicker(views, data, methods, options, std::span(rows).subspan(first));
  if (!options.pictures.empty())
    write_case_picture(pictures, options.pictures / fmt::format("{}_{}_{}_{:g}.png", labels.object, labels.bump,
                                                                labels.gloss, labels.minification));
}

/// Everything that a method needs of one shader. Pyramids of normals are the same for all glosses of a bump.
ObjectData make_data(const Surface& surface, const Shader& shader, const NormalsOptions& options,
                     const ObjectData& same_bump) {
  const auto shared = [](Pyramid<float> pyramid) { return std::make_shared<const Pyramid<float>>(std::move(pyramid)); };
  BakeOptions baking;
  baking.size = options.map_size;
  baking.progress = [&](float, std::string_view) { return !(options.cancelled && options.cancelled()); };
  ObjectData data = same_bump;
  data.map = std::make_shared<const ReductionMap>(bake(surface, shader, baking));
  data.parameters = shared(build_parameter_pyramid(surface, shader, options.map_size));
  if (!data.normals) data.normals = shared(build_normal_pyramid(surface, shader, options.map_size));
  if (!data.slopes && shader.info().perturbs_normals)
    data.slopes = shared(build_slope_pyramid(surface, shader, options.map_size));
  return data;
}

/// Evaluations of noise that make a point cost `microseconds`, on one core.
int busy_for(double microseconds) {
  if (microseconds <= 0) return 0;
  constexpr int kEvaluations = 200, kPoints = 4096;
  SurfacePoints points;
  points.resize(kPoints);
  for (std::size_t i = 0; i < kPoints; ++i)
    points.normal.set(i, Vec3{0, 0, 1}), points.position.set(i, Vec3{0.01f * static_cast<float>(i), 0, 0});
  const auto seconds = [&](int busy) {
    const auto shader = make_bumpy_shader("fbm.25", "phong100", 0.003, busy);
    double best = std::numeric_limits<double>::infinity();
    for (int repeat = 0; repeat < 5; ++repeat) {
      const auto start = std::chrono::steady_clock::now();
      shader->bind(points);
      best = std::min(best, std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
    }
    return best / kPoints;
  };
  const double idle = seconds(0), each = (seconds(kEvaluations) - idle) / kEvaluations;
  return std::clamp(static_cast<int>(std::lround((1e-6 * microseconds - idle) / each)), 0, 10000);
}

}  // namespace

std::vector<NormalsRow> measure_normals(const NormalsOptions& options) {
  // Whatever is misspelt is found before hours are spent.
  for (const std::string& object : options.objects) make_bumpy_surface(object, options.models);
  std::size_t looks = 0;
  for (const std::string& bump : options.bumps)
    for (const std::string& gloss : options.glosses)
      if (go_together(bump, gloss)) make_bumpy_shader(bump, gloss, 0.003, 0), ++looks;
  if (looks == 0)
    throw Error("no gloss goes with these bumps: expected \"grain\" with ward.1x.4 or ggx.05x.3, others with others");
  const int busy = busy_for(options.shader_microseconds);
  const double total = static_cast<double>(options.objects.size() * looks * options.minifications.size());
  double done = 0;
  std::vector<NormalsRow> rows;
  for (const std::string& object : options.objects) {
    const auto surface = make_bumpy_surface(object, options.models);
    const double texel = texel_width(*surface, options.map_size);
    for (const std::string& bump : options.bumps) {
      ObjectData data;
      for (const std::string& gloss : options.glosses) {
        if (!go_together(bump, gloss)) continue;
        const auto shader = make_bumpy_shader(bump, gloss, texel, busy);
        data = make_data(*surface, *shader, options, data);
        for (const double minification : options.minifications) {
          if (options.cancelled && options.cancelled()) throw Error("the bench was cancelled");
          if (options.progress) options.progress(done++ / total, fmt::format("{} {} {}", object, bump, gloss));
          NormalsRow labels;
          labels.object = object, labels.bump = bump, labels.gloss = gloss, labels.minification = minification;
          labels.basis = static_cast<int>(data.map->basis.size());
          measure_case(labels, make_views(labels, surface, shader, {data}, options), {data}, options, rows);
        }
      }
    }
  }
  return rows;
}

}  // namespace redmap::bench
