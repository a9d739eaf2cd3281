// What the comparisons of images and of sequences share; not part of the public interface.
#pragma once

#include "base/image.h"

namespace redmap {

/// Whether pixel (x, y) counts.
inline bool counts(const Image* mask, int x, int y) { return mask == nullptr || mask->at(x, y, 0) > 0.5f; }

/// Throws Error if sizes differ or a value is not finite.
void require_comparable(const Image& image, const Image& reference, const Image* mask);

/// Decibels of a root mean square error of values in [0, 1].
double psnr_of(double rmse_clamped);

}  // namespace redmap
