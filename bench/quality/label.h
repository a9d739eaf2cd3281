// Words in pictures.
#pragma once

#include <string>

#include "base/image.h"

namespace redmap::bench {

/// Draws one line of `text` with its top left corner at (x, y), letters 7 * scale pixels high.
void draw_label(Image& image, int x, int y, const std::string& text, int scale, Rgb color);

}  // namespace redmap::bench
