// redmap view: a scene in a window, rendered on a Vulkan device as the camera moves.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <map>
#include <memory>

#include "base/error.h"
#include "base/parallel.h"
#include "commands.h"
#include "common.h"
#include "device/device.h"
#include "gpu/device_renderer.h"
#include "metrics/compare.h"
#include "object_data.h"
#include "scene/camera_controls.h"
#include "scene/scene_file.h"
#include "view/parameter_editor.h"
#include "view/rebake.h"
#include "view/window.h"

namespace redmap::cli {

namespace {

using Clock = std::chrono::steady_clock;

struct ViewOptions {
  CommonOptions common;
  std::string scene, device, keys, screenshot;
  int frames = 0;
  std::vector<std::string> overrides;
};

constexpr const char* kKeys =
    "1 original, 2 map, 3 supersampled, 4 split: map left, original right. f: one sample a pixel or 2 x 2. b: one "
    "basis "
    "reflectance a sample. r: error against 64 samples. Drag left: orbit, right: look around; wheel: zoom; w a s d q "
    "e: "
    "fly. , and . choose a parameter, - and = change it; the map is baked again while you look. Escape: leave.";

/// Degrees a dragged pixel, zoom a step of the wheel, parts of the distance a second.
constexpr float kDragDegrees = 0.3f, kWheelZoom = 0.9f, kFlySpeed = 0.5f;

enum class Show { kOriginal, kMap, kSupersampled, kSplit };

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
        window_(scene_.camera.width, scene_.camera.height, "redmap") {
    data_ = load_object_data(scene_, Method::kMap);
  }

  void run() {
    WindowInput input;
    for (int frame = 1; window_.poll(input); ++frame) {
      stop_if_interrupted();
      if (frame == 1) input.keys = options_.keys + input.keys;
      apply(input);
      if (std::optional<RebakedScene> changed = rebake_.take()) adopt(std::move(*changed));
      scene_.camera.width = window_.width(), scene_.camera.height = window_.height();
      const auto start = Clock::now();
      window_.show(rendered(frame));
      seconds_ = std::chrono::duration<double>(Clock::now() - start).count();
      window_.set_title(title());
      if (frame == options_.frames) break;
    }
    if (!options_.screenshot.empty()) write_image(window_.screenshot(), options_.screenshot);
  }

 private:
  void apply(const WindowInput& input) {
    const float ahead = kFlySpeed * static_cast<float>(std::min(seconds_, 0.5));
    orbit(scene_.camera, -kDragDegrees * input.orbit_x, kDragDegrees * input.orbit_y);
    look(scene_.camera, kDragDegrees * input.look_x, -kDragDegrees * input.look_y);
    zoom(scene_.camera, std::pow(kWheelZoom, input.scrolled));
    fly(scene_.camera, ahead * input.right, ahead * input.up, ahead * input.forward);
    for (const char key : input.keys) press(key);
  }

  void press(char key) {
    if (key >= '1' && key <= '4') show_ = static_cast<Show>(key - '1');
    if (key == 'f') fast_ = !fast_, renderers_.clear();
    if (key == 'b') draws_one_basis_ = !draws_one_basis_, renderers_.clear();
    if (key == 'r') measure_error();
    if (key == ',' || key == '.') editor_.select(key == '.' ? 1 : -1);
    if (key != '-' && key != '=') return;
    editor_.change(key == '=' ? 1 : -1);
    std::vector<std::string> overrides = options_.overrides;
    for (std::string& each : editor_.overrides()) overrides.push_back(std::move(each));
    if (!editor_.empty())
      rebake_.start(options_.scene, overrides, options_.device, editor_.object(), data_[editor_.object()].map->size);
  }

  /// Another shader on one object; everything else stays, the camera too.
  void adopt(RebakedScene changed) {
    const Camera camera = scene_.camera;
    file_ = std::move(changed.file);
    scene_ = file_.at(1);
    scene_.camera = camera;
    data_[changed.object].map = changed.map;
    renderers_.clear();
  }

  DeviceRenderer& renderer(Method method, int spp) {
    std::unique_ptr<DeviceRenderer>& made = renderers_[{method, spp}];
    if (made) return *made;
    DeviceRenderOptions options;
    options.method = method, options.spp = spp;
    options.quality = fast_ ? Quality::kFast : Quality::kDefault;
    options.draws_one_basis = draws_one_basis_;
    made = std::make_unique<DeviceRenderer>(device_, scene_, options, data_);
    return *made;
  }
  Image picture(Method method, int frame, int spp = 0) {
    DeviceRenderer& by = renderer(method, spp);
    render_seconds_ += by.render(scene_, frame);
    return by.picture();
  }
  Image rendered(int frame) {
    render_seconds_ = 0;
    switch (show_) {
      case Show::kOriginal:
        return picture(Method::kOriginal, frame);
      case Show::kSupersampled:
        return picture(Method::kSupersample, frame);
      case Show::kSplit: {
        const Image left = picture(Method::kMap, frame);
        return split(left, picture(Method::kOriginal, frame));
      }
      case Show::kMap:
        break;
    }
    return picture(Method::kMap, frame);
  }

  void measure_error() {
    constexpr int kReferenceSpp = 64;
    CompareOptions compare;
    compare.flip = false;
    const Image seen = rendered(0);
    error_ = fmt::format(", RMSE {:.4f}",
                         compare_images(seen, picture(Method::kSupersample, 0, kReferenceSpp), compare).rmse);
  }

  std::string title() const {
    constexpr const char* kNames[] = {"original", "map", "supersampled", "map | original"};
    return fmt::format("redmap: {}, {}{}: {:.1f} ms a frame, {:.1f} ms with the window{}, {}{}",
                       kNames[static_cast<int>(show_)], fast_ ? "1 sample" : "2 x 2 samples",
                       draws_one_basis_ ? ", one basis" : "", 1e3 * render_seconds_, 1e3 * seconds_, error_,
                       editor_.text(), rebake_.is_running() ? " (baking)" : "");
  }

  ViewOptions options_;
  SceneFile file_;
  Scene scene_;
  std::shared_ptr<Device> device_;
  ParameterEditor editor_;
  Window window_;
  Rebake rebake_;
  std::vector<ObjectData> data_;
  std::map<std::pair<Method, int>, std::unique_ptr<DeviceRenderer>> renderers_;
  Show show_ = Show::kMap;
  bool fast_ = false, draws_one_basis_ = false;
  double seconds_ = 0, render_seconds_ = 0;
  std::string error_;
};

}  // namespace

void add_view_command(CLI::App& app) {
  auto options = std::make_shared<ViewOptions>();
  CLI::App* sub = app.add_subcommand("view", "Show a scene in a window, rendered on a Vulkan device");
  sub->add_option("scene", options->scene, "Scene file (TOML), baked")->required();
  sub->add_option("--keys", options->keys, "Keys pressed at the start")->type_name("KEYS");
  sub->add_option("--frames", options->frames, "Leave after so many frames; 0: when the window is closed")
      ->check(CLI::Range(0, 1 << 30))
      ->type_name("N");
  sub->add_option("--screenshot", options->screenshot, "Where the last frame is left as it stood on the screen");
  add_override_option(*sub, options->overrides);
  add_device_option(*sub, options->device);
  add_common_options(*sub, options->common);
  sub->footer(std::string("Keys: ") + kKeys + "\nExample: redmap view scenes/sphere_noise.toml --keys 4");
  sub->callback([options] {
    const ThreadLimit threads(static_cast<std::size_t>(options->common.threads));
    Viewer(*options).run();
  });
}

}  // namespace redmap::cli
