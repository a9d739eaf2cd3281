#include "laboratory.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/error.h"
#include "normals/cases.h"
#include "quality/bench_data.h"
#include "quality/bench_scene.h"
#include "quality/error_sums.h"
#include "quality/reference.h"

namespace redmap::bench {

const std::vector<PaperTexture>& paper_textures() {
  constexpr double kMinute = 60, kHour = 3600;
  // Fig. 5 (k, MB), Fig. 8 (texture calls, seconds of 300 frames), Fig. 10 (seconds of a bake).
  static const std::vector<PaperTexture> kTextures = {
      {"Thresholded Griffin", "bunny", "noise", 2, 8.4, 6392.7, 39868.6, 5 * kMinute + 1, 13 * kMinute + 16,
       6 * kMinute + 20, kMinute + 16.1, 13 * kMinute + 45.2, 2 * kMinute + 9.3, 17 * kMinute + 52},
      {"Shiny/Dull Scaled Dragon", "dragon", "scales", 2, 8.4, 6295.1, 40115.3, 8 * kMinute + 25, 16 * kMinute + 16,
       9 * kMinute + 33, kMinute + 17.7, 7 * kHour + 37 * kMinute + 53.4, 2 * kMinute + 5.6,
       7 * kHour + 41 * kMinute + 58},
      {"Stone Bunny", "bunny", "stone", 3, 9.8, 12708.3, 63171.2, 5 * kMinute + 25, 16 * kMinute + 29, 6 * kMinute + 35,
       2 * kMinute + 36.1, 7 * kHour + 3 * kMinute + 19.4, 2 * kMinute + 20, 7 * kHour + 8 * kMinute + 58},
      {"Marble Igea", "bunny", "marble", 4, 11.2, 16269.4, 66388.4, 5 * kMinute + 36, 16 * kMinute + 47,
       7 * kMinute + 9, 2 * kMinute + 20.9, 6 * kHour + 31 * kMinute + 23.6, 3 * kMinute + 0.4,
       6 * kHour + 37 * kMinute + 6},
      {"Bump Mapped Bunny", "bunny", kBump, 1, 15.4, 6282.6, 63172.5, 5 * kMinute + 32, 11 * kMinute + 41,
       6 * kMinute + 8, kMinute + 48.3, 3 * kMinute + 44.6, 2 * kMinute + 17, 9 * kMinute + 52},
      {"Transparent Bunny", "bunny", "transparent", 1, 7.0, 0, 0, 0, 0, 0, 43.5, 3 * kMinute + 41.2, 2 * kMinute + 20.1,
       7 * kMinute + 2},
  };
  return kTextures;
}

std::shared_ptr<const Surface> Laboratory::surface(const std::string& object) {
  const std::string& name = options_.object.empty() ? object : options_.object;
  auto& surface = surfaces_[name];
  if (!surface) surface = make_bench_surface(name, options_.models);
  return surface;
}

std::shared_ptr<const Shader> Laboratory::shader(const std::string& object, const std::string& name) {
  const auto bumps = bump_names();
  if (std::find(bumps.begin(), bumps.end(), name) == bumps.end()) return make_library_shader(name);
  return make_bumpy_shader(name, kBumpGloss, texel_width(*surface(object), options_.map_size), 0);
}

BakedTexture Laboratory::baked(const std::string& object, const std::string& name) {
  // The paper's six, and one or two more: each has some hundred megabytes with all that the baselines need.
  constexpr std::size_t kMostKept = 8;
  const std::string& on = options_.object.empty() ? object : options_.object;
  const auto found = std::find_if(baked_.begin(), baked_.end(),
                                  [&](const Kept& kept) { return kept.object == on && kept.shader == name; });
  if (found != baked_.end()) {
    baked_.splice(baked_.begin(), baked_, found);
    return baked_.front().texture;
  }
  BakedTexture texture;
  texture.surface = surface(object), texture.shader = shader(object, name);
  texture.data = {
      make_bench_data(*texture.surface, *texture.shader, options_.map_size, options_.cancelled, &texture.report)};
  baked_.push_front({on, name, texture});
  if (baked_.size() > kMostKept) baked_.pop_back();
  return texture;
}

void Laboratory::begin(const std::string& what, std::size_t index, std::size_t count) {
  what_ = what;
  width_ = 1 / static_cast<double>(count), first_ = static_cast<double>(index) * width_;
  step(0);
}

void Laboratory::step(double part_of_figure) {
  if (options_.cancelled && options_.cancelled()) throw Error("the bench was cancelled");
  if (options_.progress) options_.progress(first_ + width_ * std::min(part_of_figure, 1.0), what_);
}

NamedMethod samples_method(int spp) {
  NamedMethod method{fmt::format("samples_{}", spp), fmt::format("{} sample{}", spp, spp == 1 ? "" : "s"), {}};
  method.options.method = Method::kSupersample, method.options.spp = spp;
  return method;
}

NamedMethod paper_method() {
  NamedMethod method{"paper", "map, the paper's way", {}};
  method.options.method = Method::kPaper;
  return method;
}

NamedMethod map_method(Quality quality) {
  const std::string name(name_of(quality));
  const bool plain = quality == Quality::kDefault;
  NamedMethod method{plain ? "map" : "map_" + name, plain ? "map" : "map, " + name, {}};
  method.options.quality = quality;
  return method;
}

std::vector<NamedMethod> compared_methods() {
  return {samples_method(1),
          samples_method(16),
          paper_method(),
          map_method(Quality::kFast),
          map_method(Quality::kBalanced),
          map_method(Quality::kDefault)};
}

NamedMethod parameters_method() {
  NamedMethod method{"parameters", "averaged parameters", {}};
  method.options.method = Method::kParameters;
  return method;
}

Scene scene_of(const BakedTexture& texture, int size, double minification, int view, int largest) {
  return make_bench_scene(texture.surface, texture.shader, size, minification, view, largest);
}

Image render_picture(const Scene& scene, const std::vector<ObjectData>& data, const RenderOptions& options, int frame) {
  return Renderer(scene, options, data).render(scene, frame).image;
}

Slider compare_methods(const std::string& title, const Scene& scene, const std::vector<ObjectData>& data,
                       int reference_spp, int zoom) {
  Slider slider{title, {}, zoom};
  slider.pictures.push_back({"1 sample", render_picture(scene, data, samples_method(1).options)});
  slider.pictures.push_back({"16 samples", render_picture(scene, data, samples_method(16).options)});
  if (std::all_of(data.begin(), data.end(), [](const ObjectData& object) { return object.parameters != nullptr; }))
    slider.pictures.push_back({"averaged parameters", render_picture(scene, data, parameters_method().options)});
  slider.pictures.push_back({"map, the paper's way", render_picture(scene, data, paper_method().options)});
  slider.pictures.push_back({"map", render_picture(scene, data, map_method(Quality::kDefault).options)});
  std::vector<PixelClass> classes;
  ErrorSums between_halves;
  slider.pictures.push_back({"reference", render_reference(scene, data, reference_spp, 0, classes, between_halves)});
  return slider;
}

std::vector<SequenceCost> render_sequence(const std::function<Scene(int)>& scene_at, int frames,
                                          const std::vector<ObjectData>& data, const std::vector<NamedMethod>& methods,
                                          const std::function<void(double)>& step) {
  std::vector<std::unique_ptr<Renderer>> renderers;
  for (const NamedMethod& method : methods)
    renderers.push_back(std::make_unique<Renderer>(scene_at(0), method.options, data));
  std::vector<SequenceCost> costs(methods.size());
  for (int frame = 0; frame < frames; ++frame) {
    step(static_cast<double>(frame) / frames);
    const Scene scene = scene_at(frame);
    for (std::size_t i = 0; i < methods.size(); ++i) {
      const RenderedFrame rendered = renderers[i]->render(scene, frame);
      costs[i].seconds += rendered.seconds, costs[i].counts += rendered.counts;
      costs[i].pixels += static_cast<double>(rendered.image.pixels());
    }
  }
  return costs;
}

SequenceErrors measure_errors(const std::function<Scene(int)>& scene_at, std::span<const int> frames,
                              const std::vector<ObjectData>& data, const std::vector<NamedMethod>& methods,
                              int reference_spp) {
  std::vector<std::unique_ptr<Renderer>> renderers;
  for (const NamedMethod& method : methods)
    renderers.push_back(std::make_unique<Renderer>(scene_at(0), method.options, data));
  std::vector<ErrorSums> sums(methods.size());
  ErrorSums between_halves;
  for (const int frame : frames) {
    const Scene scene = scene_at(frame);
    std::vector<PixelClass> classes;
    const Image reference = render_reference(scene, data, reference_spp, frame, classes, between_halves);
    for (std::size_t i = 0; i < methods.size(); ++i)
      sums[i].add(renderers[i]->render(scene, frame).image, reference, classes);
  }
  SequenceErrors errors;
  for (const ErrorSums& sum : sums)
    errors.rmse.push_back(sum.interior()), errors.rmse_clamped.push_back(sum.interior_clamped());
  errors.residual = between_halves.interior() / 2, errors.mean = between_halves.mean_reference();
  return errors;
}

}  // namespace redmap::bench
