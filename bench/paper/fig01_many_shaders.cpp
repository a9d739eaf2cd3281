// Fig. 1: a scene of many shaders, and a camera that flies away from it for 840 frames.
#include <cmath>

#include "figures.h"
#include "quality/error_sums.h"
#include "quality/reference.h"

namespace redmap::bench {

namespace {

constexpr int kPaperFrames = 840;
constexpr double kPaperHours16 = 10.5, kPaperHoursMap = 3.0, kPaperCalls16 = 280e6, kPaperCallsMap = 60e6;
/// Of its animations the paper says nothing; these pictures are small enough for all frames to take minutes.
constexpr int kWidth = 320, kHeight = 180;

struct Shown {
  const char *object, *shader;
};
constexpr Shown kShown[] = {{"sphere", "noise"},   {"dragon", "scales"},    {"bunny", "stone"},
                            {"bunny", "marble"},   {"sphere", "checker"},   {"cylinder", "wood"},
                            {"sphere", "wet_dry"}, {"bunny", "worn_paint"}, {"sphere", "chrome_rubber"}};
constexpr int kColumns = 3;
constexpr float kSpacing = 2.6f;

/// Nine objects of radius 1 in three rows.
std::pair<Scene, std::vector<ObjectData>> make_gallery(Laboratory& laboratory) {
  Scene scene;
  std::vector<ObjectData> data;
  for (const Shown& shown : kShown) {
    const BakedTexture texture = laboratory.baked(shown.object, shown.shader);
    const int i = static_cast<int>(scene.objects.size());
    Object object;
    object.name = object.declared_name = std::string(shown.shader) + std::to_string(i);
    object.surface = texture.surface, object.shader = texture.shader;
    object.map_size = laboratory.options().map_size;
    const Vec3 centre = (texture.surface->lower() + texture.surface->upper()) * 0.5f;
    const Vec3 extent = texture.surface->upper() - texture.surface->lower();
    object.transform.scale = 2 / std::max({extent.x, extent.y, extent.z});
    const Vec3 place{kSpacing * static_cast<float>(i % kColumns - 1), 0, -kSpacing * static_cast<float>(i / kColumns)};
    object.transform.translate = place - centre * object.transform.scale;
    scene.objects.push_back(object);
    data.push_back(texture.data.front());
  }
  Light sun;
  sun.type = Light::Type::kDirectional;
  sun.to_light = normalized(Vec3{0.5f, 1, 0.7f});
  sun.intensity = Rgb{1, 1, 1} * kPi;
  scene.lights.push_back(sun);
  scene.background = {0.35f, 0.45f, 0.6f};
  scene.camera.width = kWidth, scene.camera.height = kHeight;
  scene.camera.look_at = {0, 0, -kSpacing};
  return {scene, data};
}

/// The camera goes from the edge of the gallery to six times as far, evenly in logarithms, and round it by a third.
Scene at_frame(const Scene& gallery, int frame) {
  Scene scene = gallery;
  const float t = static_cast<float>(frame) / kPaperFrames;
  const float distance = 7 * std::pow(6.0f, t), angle = -0.6f + 2 * t;
  scene.camera.position =
      scene.camera.look_at + Vec3{distance * std::sin(angle), 0.45f * distance, distance * std::cos(angle)};
  return scene;
}

}  // namespace

Figure measure_fig1(Laboratory& laboratory) {
  Figure figure;
  figure.title = "Fig. 1: a scene of many shaders";
  figure.paper =
      "840 frames of one scene: 10.5 hours at 16 samples a pixel, which aliases, 3.0 hours by the maps; 280 and 60 "
      "million texture calls.";
  const int frames = laboratory.options().all_frames ? kPaperFrames : laboratory.samples(84, 12);
  figure.ours = "Nine objects, nine shaders, a camera that flies to six times its distance; " + std::to_string(frames) +
                " of 840 frames of 320 x 180 pixels, evenly spaced; hours and calls are extrapolated to 840. Errors "
                "are over the interior of the objects.";
  const auto [gallery, data] = make_gallery(laboratory);
  const std::vector<NamedMethod> methods{samples_method(1),
                                         samples_method(16),
                                         parameters_method(),
                                         paper_method(),
                                         map_method(Quality::kFast),
                                         map_method(Quality::kBalanced),
                                         map_method(Quality::kDefault)};
  const int stride = kPaperFrames / frames;
  const auto scene_at = [&, &scene = gallery](int frame) { return at_frame(scene, frame * stride); };
  const auto costs =
      render_sequence(scene_at, frames, data, methods, [&](double part) { laboratory.step(0.7 * part); });
  std::vector<int> error_frames;
  for (int i = 0; i < laboratory.samples(6, 2); ++i) error_frames.push_back(i * (frames - 1) / 5);
  const SequenceErrors errors = measure_errors(scene_at, error_frames, data, methods, laboratory.samples(1024, 128));
  Table table{"flight",
              "840 frames",
              {{"method", "method"},
               {"paper_hours", "hours, paper"},
               {"hours", "hours here"},
               {"paper_million_calls", "million calls, paper"},
               {"million_calls", "here"},
               {"paper_speed_up", "16 samples / it, paper"},
               {"speed_up", "here"},
               {"rmse", "RMSE"},
               {"residual", "residual"}},
              {}};
  for (std::size_t i = 0; i < methods.size(); ++i) {
    const bool is_16 = i == 1, is_paper = i == 3;
    const auto only = [&](double of_16, double of_map) {
      return is_16 ? Value(of_16) : is_paper ? Value(of_map) : Value();
    };
    table.rows.push_back({methods[i].label, only(kPaperHours16, kPaperHoursMap),
                          costs[i].seconds / frames * kPaperFrames / 3600,
                          only(1e-6 * kPaperCalls16, 1e-6 * kPaperCallsMap),
                          1e-6 * static_cast<double>(costs[i].counts.shader_calls) / frames * kPaperFrames,
                          only(1, kPaperHours16 / kPaperHoursMap), costs[1].seconds / costs[i].seconds, errors.rmse[i],
                          errors.residual});
  }
  double speed_up = 0;
  for (const std::size_t quality : {4, 5, 6})
    if (errors.rmse[quality] <= errors.rmse[1])
      speed_up = std::max(speed_up, costs[1].seconds / costs[quality].seconds);
  figure.tables.push_back(std::move(table));
  figure.claims.push_back({"16 samples / map, at their quality or better: the paper's 3.5 or more", text_of(speed_up),
                           speed_up >= kPaperHours16 / kPaperHoursMap});
  const Scene far = at_frame(gallery, kPaperFrames / 2);
  figure.sliders.push_back(compare_methods("Half-way through the flight", far, data, laboratory.samples(1024, 128), 2));
  return figure;
}

}  // namespace redmap::bench
