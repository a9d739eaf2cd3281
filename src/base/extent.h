// Grids of texels.
#pragma once

namespace redmap {

/// Width and height of a grid of texels.
struct Extent {
  int width = 0, height = 0;
  friend bool operator==(const Extent&, const Extent&) = default;
};

/// Texels [x, x + width) x [y, y + height). Row y = 0 holds the smallest v.
struct TexelRegion {
  int x = 0, y = 0, width = 0, height = 0;
};

}  // namespace redmap
