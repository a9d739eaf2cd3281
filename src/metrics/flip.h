// The perceived difference of two pictures that alternate on a screen: LDR-FLIP of Andersson, Nilsson, Akenine-Moller,
// Oskarsson, Astrom and Fairchild, "FLIP: A Difference Evaluator for Alternating Images" (HPG 2020).
#pragma once

#include "base/image.h"

namespace redmap {

struct FlipOptions {
  /// Pixels a degree of the visual field: the paper's screen of .7 m and 3840 pixels, seen from .7 m.
  float pixels_per_degree = 67;
};

/// Difference of each pixel in [0, 1], one channel. Both pictures hold linear light, which is clamped to [0, 1]; they
/// have the same size and only finite values (`compare_images` checks both).
Image flip_difference(const Image& image, const Image& reference, const FlipOptions& options = {});

}  // namespace redmap
