#include "view/window.h"

#include <GLFW/glfw3.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "base/error.h"
#include "base/srgb.h"

namespace redmap::cli {

namespace {

/// Steps of linear light from 0 to 1: finer than a byte everywhere but in the darkest ten levels.
constexpr int kSteps = 1 << 12;

std::uint8_t srgb_byte(float linear) {
  static const std::array<std::uint8_t, kSteps + 1> table = [] {
    std::array<std::uint8_t, kSteps + 1> t;
    for (int i = 0; i <= kSteps; ++i)
      t[i] = static_cast<std::uint8_t>(std::lround(255 * linear_to_srgb(static_cast<float>(i) / kSteps)));
    return t;
  }();
  return table[static_cast<int>(std::clamp(linear, 0.0f, 1.0f) * kSteps + 0.5f)];
}

}  // namespace

struct Window::Impl {
  GLFWwindow* window = nullptr;
  std::function<void()> overlay;
  WindowInput input;
  double x = 0, y = 0;
  std::vector<std::uint8_t> bytes;  ///< of what is shown, lowest row first
  int columns = 0, rows = 0;

  static Impl& of(GLFWwindow* window) { return *static_cast<Impl*>(glfwGetWindowUserPointer(window)); }
  bool is_down(int key) const { return glfwGetKey(window, key) == GLFW_PRESS; }
  float axis(int positive, int negative) const {
    return static_cast<float>(is_down(positive)) - static_cast<float>(is_down(negative));
  }
  void drag(double to_x, double to_y) {
    const float dx = static_cast<float>(to_x - x), dy = static_cast<float>(to_y - y);
    x = to_x, y = to_y;
    if (glfwGetMouseButton(window, GLFW_MOUSE_BUTTON_LEFT) == GLFW_PRESS) input.orbit_x += dx, input.orbit_y += dy;
    if (glfwGetMouseButton(window, GLFW_MOUSE_BUTTON_RIGHT) == GLFW_PRESS) input.look_x += dx, input.look_y += dy;
  }
  void listen() {
    glfwSetWindowUserPointer(window, this);
    glfwSetCharCallback(window, [](GLFWwindow* w, unsigned code) {
      if (code < 128) of(w).input.keys += static_cast<char>(std::tolower(static_cast<int>(code)));
    });
    glfwSetScrollCallback(window,
                          [](GLFWwindow* w, double, double dy) { of(w).input.scrolled += static_cast<float>(dy); });
    glfwSetCursorPosCallback(window, [](GLFWwindow* w, double to_x, double to_y) { of(w).drag(to_x, to_y); });
    glfwGetCursorPos(window, &x, &y);
  }
};

Window::Window(int width, int height, const std::string& title) : impl_(std::make_unique<Impl>()) {
  if (!glfwInit()) throw Error("view: expected a display, found none (set DISPLAY, or render to a file)");
  impl_->window = glfwCreateWindow(width, height, title.c_str(), nullptr, nullptr);
  if (!impl_->window) {
    glfwTerminate();
    throw Error("view: expected a display with OpenGL, found none (render to a file instead)");
  }
  glfwMakeContextCurrent(impl_->window);
  glfwSwapInterval(0);
  impl_->listen();
}

Window::~Window() {
  glfwDestroyWindow(impl_->window);
  glfwTerminate();
}

bool Window::poll(WindowInput& input) {
  impl_->input = {};
  glfwPollEvents();
  impl_->input.right = impl_->axis(GLFW_KEY_D, GLFW_KEY_A);
  impl_->input.up = impl_->axis(GLFW_KEY_E, GLFW_KEY_Q);
  impl_->input.forward = impl_->axis(GLFW_KEY_W, GLFW_KEY_S);
  input = impl_->input;
  return !glfwWindowShouldClose(impl_->window) && !impl_->is_down(GLFW_KEY_ESCAPE);
}

int Window::width() const {
  int w = 0, h = 0;
  glfwGetFramebufferSize(impl_->window, &w, &h);
  return std::max(w, 1);
}
int Window::height() const {
  int w = 0, h = 0;
  glfwGetFramebufferSize(impl_->window, &w, &h);
  return std::max(h, 1);
}

GLFWwindow* Window::handle() const { return impl_->window; }

void Window::set_title(const std::string& title) { glfwSetWindowTitle(impl_->window, title.c_str()); }

void Window::show(const Image& image, const std::function<void()>& overlay) {
  std::vector<std::uint8_t> bytes(3 * image.pixels());
  const std::size_t row = 3 * static_cast<std::size_t>(image.width);
  for (int y = 0; y < image.height; ++y)  // OpenGL's first row is the lowest
    for (std::size_t i = 0; i < row; ++i)
      bytes[static_cast<std::size_t>(image.height - 1 - y) * row + i] =
          srgb_byte(image.data[static_cast<std::size_t>(y) * row + i]);
  impl_->bytes = std::move(bytes), impl_->columns = image.width, impl_->rows = image.height;
  impl_->overlay = overlay;
  draw();
  glfwSwapBuffers(impl_->window);
}

void Window::draw() const {
  glViewport(0, 0, width(), height());
  glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
  glRasterPos2f(-1, -1);
  glDrawPixels(impl_->columns, impl_->rows, GL_RGB, GL_UNSIGNED_BYTE, impl_->bytes.data());
  if (impl_->overlay) impl_->overlay();
}

Image Window::screenshot() const {
  Image image(width(), height(), 3);
  std::vector<std::uint8_t> bytes(image.data.size());
  glPixelStorei(GL_PACK_ALIGNMENT, 1);
  draw();
  glReadBuffer(GL_BACK);
  glReadPixels(0, 0, image.width, image.height, GL_RGB, GL_UNSIGNED_BYTE, bytes.data());
  const std::size_t row = 3 * static_cast<std::size_t>(image.width);
  for (std::size_t i = 0; i < bytes.size(); ++i)
    image.data[(static_cast<std::size_t>(image.height) - 1 - i / row) * row + i % row] =
        srgb_to_linear(static_cast<float>(bytes[i]) / 255);
  return image;
}

}  // namespace redmap::cli
