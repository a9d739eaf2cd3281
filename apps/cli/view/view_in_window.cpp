// `redmap view` in a window: a scene, rendered on a Vulkan device as the camera moves.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <map>
#include <memory>
#include <tuple>
#include <utility>

#include "base/error.h"
#include "common.h"
#include "device/device.h"
#include "gpu/device_renderer.h"
#include "metrics/compare.h"
#include "object_data.h"
#include "render/renderer.h"
#include "scene/camera_controls.h"
#include "scene/scene_file.h"
#include "view/panel.h"
#include "view/parameter_editor.h"
#include "view/rebake.h"
#include "view/window.h"
#include "view_options.h"

namespace redmap::cli {

namespace {

using Clock = std::chrono::steady_clock;

/// Degrees a dragged pixel, zoom a step of the wheel, parts of the distance a second.
constexpr float kDragDegrees = 0.3f, kWheelZoom = 0.9f, kFlySpeed = 0.5f;

/// Left half of one, right half of the other, with a line between.
Image split(const Image& left, const Image& right) {
  Image both = right;
  const int middle = both.width / 2;
  for (int y = 0; y < both.height; ++y) {
    for (int x = 0; x < middle; ++x) both.set_rgb(x, y, left.rgb(x, y));
    both.set_rgb(middle, y, {1, 1, 1});
  }
  return both;
}

class Viewer {
 public:
  explicit Viewer(const ViewOptions& options)
      : options_(options),
        file_(SceneFile::load(options.scene, options.overrides, options.device)),
        scene_(file_.at(1)),
        device_(Device::open(options.device)),
        editor_(scene_),
        window_(scene_.camera.width, scene_.camera.height, "redmap"),
        panel_(window_),
        data_(load_object_data(scene_, Method::kMap)) {}

  void run() {
    WindowInput input;
    for (int frame = 1; window_.poll(input); ++frame) {
      stop_if_interrupted();
      if (frame == 1) input.keys = options_.keys + input.keys;
      apply(input);
      take_rebaked();
      scene_.camera.width = window_.width(), scene_.camera.height = window_.height();
      const auto start = Clock::now();
      const Image picture = rendered(frame);
      if (std::exchange(state_.wants_error, false)) measure_error(picture);
      panel_.lay_out(state_, editor_);
      window_.show(picture, [this] { panel_.draw(); });
      state_.frame_seconds = std::chrono::duration<double>(Clock::now() - start).count();
      window_.set_title(title());
      if (frame == options_.frames) break;
    }
    if (!options_.screenshot.empty()) write_image(window_.screenshot(), options_.screenshot);
  }

 private:
  void apply(const WindowInput& input) {
    const float ahead = kFlySpeed * static_cast<float>(std::min(state_.frame_seconds, 0.5));
    if (!panel_.wants_mouse()) {
      orbit(scene_.camera, -kDragDegrees * input.orbit_x, kDragDegrees * input.orbit_y);
      look(scene_.camera, kDragDegrees * input.look_x, -kDragDegrees * input.look_y);
      zoom(scene_.camera, std::pow(kWheelZoom, input.scrolled));
    }
    if (!panel_.wants_keys()) {
      fly(scene_.camera, ahead * input.right, ahead * input.up, ahead * input.forward);
      for (const char key : input.keys) press(key);
    }
    start_baking();
  }

  void press(char key) {
    if (key >= '1' && key <= '6') state_.show = static_cast<Show>(key - '1'), state_.message.clear();
    if (key == 'f') state_.fast = !state_.fast;
    if (key == 'b') state_.draws_one_basis = !state_.draws_one_basis;
    if (key == 'p') state_.shows_panel = !state_.shows_panel;
    if (key == 'r') state_.wants_error = true;
    if (key == ',' || key == '.') editor_.select(key == '.' ? 1 : -1);
    if (key == '-' || key == '=') editor_.change(key == '=' ? 1 : -1);
  }

  /// Of all objects that wait for it, whenever one more parameter was changed.
  void start_baking() {
    std::vector<std::string> overrides = options_.overrides;
    for (std::string& each : editor_.overrides()) overrides.push_back(std::move(each));
    if (editor_.unbaked_objects().empty() || overrides == asked_for_) return;
    std::vector<Rebake::Wanted> wanted;
    for (const std::size_t object : editor_.unbaked_objects()) wanted.push_back({object, data_[object].map->size});
    rebake_.start(options_.scene, overrides, options_.device, wanted);
    asked_for_ = std::move(overrides);
  }

  /// Other shaders on some objects; everything else stays, the camera too.
  void take_rebaked() {
    try {
      if (std::optional<RebakedScene> changed = rebake_.take()) {
        const Camera camera = scene_.camera;
        file_ = std::move(changed->file);
        scene_ = file_.at(1);
        scene_.camera = camera;
        for (const RebakedScene::Map& each : changed->maps) data_[each.object] = {each.map, nullptr, nullptr};
        renderers_.clear(), paper_.reset();
        editor_.settle();
        state_.message.clear();
      }
    } catch (const Error& error) {
      state_.message = error.what();
    }
    state_.is_baking = rebake_.is_running();
  }

  /// With what `method` needs besides the maps.
  std::vector<ObjectData> data_for(Method method) {
    for (std::size_t i = 0; i < data_.size(); ++i)
      if (method == Method::kPaper ? !data_[i].normals : !data_[i].parameters)
        add_baseline(scene_.objects[i], method, data_[i].map->size, data_[i]);
    return data_;
  }

  DeviceRenderer& renderer(Method method, int spp) {
    std::unique_ptr<DeviceRenderer>& made = renderers_[std::tuple(method, spp, state_.fast, state_.draws_one_basis)];
    if (made) return *made;
    DeviceRenderOptions options;
    options.method = method, options.spp = spp;
    options.quality = state_.fast ? Quality::kFast : Quality::kDefault;
    options.draws_one_basis = state_.draws_one_basis;
    made = std::make_unique<DeviceRenderer>(device_, scene_, options, data_for(method));
    return *made;
  }
  Image picture(Method method, int frame, int spp = 0) {
    DeviceRenderer& by = renderer(method, spp);
    state_.render_seconds += by.render(scene_, frame);
    return by.picture();
  }
  /// Devices do not know it.
  Image paper_picture(int frame) {
    RenderOptions options;
    options.method = Method::kPaper;
    if (!paper_) paper_ = std::make_unique<Renderer>(scene_, options, data_for(Method::kPaper));
    RenderedFrame rendered = paper_->render(scene_, frame);
    state_.render_seconds += rendered.seconds;
    return std::move(rendered.image);
  }
  Image shown(int frame) {
    switch (state_.show) {
      case Show::kOriginal:
        return picture(Method::kOriginal, frame);
      case Show::kSupersampled:
        return picture(Method::kSupersample, frame);
      case Show::kParameters:
        return picture(Method::kParameters, frame);
      case Show::kPaper:
        return paper_picture(frame);
      case Show::kSplit: {
        const Image left = picture(Method::kMap, frame);
        return split(left, picture(Method::kOriginal, frame));
      }
      case Show::kMap:
        break;
    }
    return picture(Method::kMap, frame);
  }
  /// What cannot be shown is said, and the map shown instead.
  Image rendered(int frame) {
    state_.render_seconds = 0;
    try {
      return shown(frame);
    } catch (const Error& error) {
      if (state_.show == Show::kMap) throw;
      state_.message = error.what(), state_.show = Show::kMap;
    }
    return shown(frame);
  }

  void measure_error(const Image& seen) {
    constexpr int kReferenceSpp = 64;
    CompareOptions compare;
    compare.flip = false;
    const double seconds = state_.render_seconds;
    state_.error = compare_images(seen, picture(Method::kSupersample, 0, kReferenceSpp), compare).rmse;
    state_.render_seconds = seconds;
  }

  std::string title() const {
    return fmt::format("redmap: {}, {}{}: {:.1f} ms a frame, {}{}", kShowNames[static_cast<int>(state_.show)],
                       state_.fast ? "1 sample" : "2 x 2 samples", state_.draws_one_basis ? ", one basis" : "",
                       1e3 * state_.render_seconds, editor_.text(), state_.is_baking ? " (baking)" : "");
  }

  ViewOptions options_;
  SceneFile file_;
  Scene scene_;
  std::shared_ptr<Device> device_;
  ParameterEditor editor_;
  Window window_;
  Panel panel_;
  Rebake rebake_;
  std::vector<std::string> asked_for_;  ///< of the last bake
  std::vector<ObjectData> data_;
  std::map<std::tuple<Method, int, bool, bool>, std::unique_ptr<DeviceRenderer>> renderers_;
  std::unique_ptr<Renderer> paper_;
  ViewState state_;
};

}  // namespace

void view_in_window(const ViewOptions& options) { Viewer(options).run(); }

}  // namespace redmap::cli
