// `redmap view`: a scene to walk around in, in a window or in a browser.
#include <memory>

#include "base/error.h"
#include "base/parallel.h"
#include "commands.h"
#include "view_options.h"

namespace redmap::cli {

namespace {

constexpr const char* kKeys =
    "1 original, 2 map, 3 supersampled, 4 averaged parameters, 5 the paper's method (on the CPU, slow), 6 split: map "
    "left, original right. f: one sample a pixel or 2 x 2. b: one basis reflectance a light. r: error against 64 "
    "samples. p: the panel with a slider a parameter; , and . choose one too, - and = change it; maps are baked again "
    "while you look. Drag left: orbit, right: look around; wheel: zoom; w a s d q e: fly. Escape: leave.";

void add_window_options(CLI::App& sub, ViewOptions& options) {
  sub.add_option("--keys", options.keys, "Keys pressed at the start")->type_name("KEYS");
  sub.add_option("--frames", options.frames, "Leave after so many frames; 0: when the window is closed")
      ->check(CLI::Range(0, 1 << 30))
      ->type_name("N");
  sub.add_option("--screenshot", options.screenshot, "Where the last frame is left as it stood on the screen");
}

void add_page_options(CLI::App& sub, ViewOptions& options) {
  CLI::Option* web = sub.add_flag("--web", options.web, "On a page for a browser, served on this machine until Ctrl-C");
  sub.add_option("--port", options.port, "Of the page; default: any that is free")
      ->check(CLI::Range(1, 65535))
      ->needs(web);
  sub.add_option("-o,--output", options.output, "Folder to write the page to, for a server of static files")
      ->needs(web);
}

}  // namespace

void add_view_command(CLI::App& app) {
  auto options = std::make_shared<ViewOptions>();
  CLI::App* sub = app.add_subcommand("view", "Show a scene in a window, rendered on a Vulkan device, or in a browser");
  sub->add_option("scene", options->scene, "Scene file (TOML), baked")->required();
  add_window_options(*sub, *options);
  add_page_options(*sub, *options);
  add_override_option(*sub, options->overrides);
  add_device_option(*sub, options->device);
  add_common_options(*sub, options->common);
  sub->footer(std::string("Keys: ") + kKeys +
              "\nExamples:\n"
              "  redmap view scenes/sphere_noise.toml --keys 6\n"
              "  redmap view --web scenes/sphere_noise.toml");
  sub->callback([options] {
    const ThreadLimit threads(static_cast<std::size_t>(options->common.threads));
    if (options->web) return view_in_browser(*options);
#ifdef REDMAP_HAS_WINDOW
    view_in_window(*options);
#else
    throw Error("view: expected --web: this program was built without windows (GLFW and Dear ImGui)");
#endif
  });
}

}  // namespace redmap::cli
