#include "label.h"

#include <stb/stb_easy_font.h>

#include <algorithm>
#include <array>

namespace redmap::bench {

namespace {

struct Vertex {  // as stb_easy_font writes them
  float x, y, z;
  unsigned char color[4];
};

}  // namespace

void draw_label(Image& image, int x, int y, const std::string& text, int scale, Rgb color) {
  std::array<Vertex, 16384> vertices;
  std::string line = text;
  const int quads = stb_easy_font_print(0, 0, line.data(), nullptr, vertices.data(), sizeof(vertices));
  for (int q = 0; q < quads; ++q) {
    // Every quad is a box; its corners 0 and 2 are opposite.
    const Vertex &lo = vertices[4 * q], &hi = vertices[4 * q + 2];
    const auto pixel = [&](float at, int origin) { return origin + static_cast<int>(at * static_cast<float>(scale)); };
    for (int j = std::max(0, pixel(lo.y, y)); j < std::min(image.height, pixel(hi.y, y)); ++j)
      for (int i = std::max(0, pixel(lo.x, x)); i < std::min(image.width, pixel(hi.x, x)); ++i)
        image.set_rgb(i, j, color);
  }
}

}  // namespace redmap::bench
