// What `redmap view` is asked for, and its two ways to show it: a window, and a page for a browser.
#pragma once

#include <string>
#include <vector>

#include "common.h"

namespace redmap::cli {

struct ViewOptions {
  CommonOptions common;
  std::string scene, device;
  std::vector<std::string> overrides;

  // The window.
  std::string keys, screenshot;
  int frames = 0;

  // The page.
  bool web = false;
  int port = 0;        ///< 0: any that is free
  std::string output;  ///< a folder to write page and scene to; empty: they are served
};

/// Until the window is closed. Only where there is GLFW. Throws Error.
void view_in_window(const ViewOptions& options);
/// Until Ctrl-C, or until the folder is written. Throws Error.
void view_in_browser(const ViewOptions& options);

}  // namespace redmap::cli
