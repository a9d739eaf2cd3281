// What can be wrong with pictures that are to be compared.
#include "metrics/compare_checks.h"

#include <cmath>

#include "base/error.h"

namespace redmap {

namespace {

void require_same_size(const char* what, const Image& image, const Image& reference) {
  if (image.width != reference.width || image.height != reference.height)
    throw Error("compare: expected {} of the reference's size, {} x {}, found {} x {}", what, reference.width,
                reference.height, image.width, image.height);
}

void require_finite(const char* what, const Image& image) {
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) {
      const Rgb c = image.rgb(x, y);
      const bool finite = std::isfinite(c.r) && std::isfinite(c.g) && std::isfinite(c.b);
      if (!finite)
        throw Error("compare: expected finite values in the {}, found ({}, {}, {}) at pixel ({}, {})", what, c.r, c.g,
                    c.b, x, y);
    }
}

}  // namespace

void require_comparable(const Image& image, const Image& reference, const Image* mask) {
  require_same_size("a picture", image, reference);
  if (mask) require_same_size("a mask", *mask, reference);
  require_finite("picture", image);
  require_finite("reference", reference);
}

}  // namespace redmap
