// The footprint of a pixel (or of one of its sub-pixels) in the map.
#pragma once

#include "base/vec.h"

namespace redmap {

/// A parallelogram in uv: centre, and how uv changes over one (sub-)pixel step in x and in y. Box filter over it.
struct Footprint {
  Vec2 uv;
  Vec2 duv_dx, duv_dy;
};

}  // namespace redmap
