// A window that shows pictures and says what was pressed. GLFW, and OpenGL for nothing but pixels on the screen.
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "base/image.h"

struct GLFWwindow;

namespace redmap::cli {

/// What was done since the last frame. Distances are in pixels of the window.
struct WindowInput {
  std::string keys;                ///< pressed, in their order: letters in lower case, digits and signs
  float orbit_x = 0, orbit_y = 0;  ///< dragged with the left button
  float look_x = 0, look_y = 0;    ///< with the right one
  float scrolled = 0;
  float right = 0, up = 0, forward = 0;  ///< keys that are down: d - a, e - q, w - s
};

class Window {
 public:
  /// Throws Error where there is no display.
  Window(int width, int height, const std::string& title);
  ~Window();
  Window(const Window&) = delete;
  Window& operator=(const Window&) = delete;

  GLFWwindow* handle() const;
  /// Waits for nothing. False once the window was closed.
  bool poll(WindowInput& input);
  /// Pixels of the picture that fits now.
  int width() const;
  int height() const;
  void set_title(const std::string& title);
  /// Linear RGB, as large as fits, with what `overlay` draws over it by OpenGL.
  void show(const Image& image, const std::function<void()>& overlay = {});
  /// What is shown, as the screen has it, linear RGB.
  Image screenshot() const;

 private:
  void draw() const;
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace redmap::cli
