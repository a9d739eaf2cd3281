// Raw texels under a footprint, each by the area that the footprint has of it: for what cannot be interpolated before
// it is shaded, normals and tangents (docs/normals.md).
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "base/extent.h"
#include "map/pyramid.h"

namespace redmap {

/// Which levels of a pyramid a footprint gathers from: `level` with part 1 - coarse_part, and level + 1.
struct GatherPlan {
  Footprint footprint;  ///< widened where it is too narrow
  int level = 0;
  float coarse_part = 0;
};
/// On the level where `texels` to twice as many lie across it. `extent` is that of level 0 of a pyramid of `levels`
/// levels, `footprint` finite.
GatherPlan plan_gather(const Footprint& footprint, Extent extent, int levels, float texels);

inline bool is_finite(const Footprint& f) {
  return std::isfinite(f.uv.x + f.uv.y + f.duv_dx.x + f.duv_dx.y + f.duv_dy.x + f.duv_dy.y);
}

/// What a footprint has of a texel: a parallelogram with sides along its own.
struct TexelPart {
  float area = 0;              ///< relative to other texels'
  Vec2 offset;                 ///< of its middle from the texel's, in texels
  float missing_x, missing_y;  ///< what cutting took off the squares of its sides, 0 (whole) to 1
  bool whole() const { return missing_x <= 0 && missing_y <= 0; }
};

/// The texels of one level that a footprint, a parallelogram, overlaps.
class FootprintTexels {
 public:
  FootprintTexels(const Footprint& footprint, Extent extent, bool wraps_u);
  /// At most so many.
  std::size_t most() const {
    return x1_ < x0_ || y1_ < y0_ ? 0 : static_cast<std::size_t>(x1_ - x0_ + 1) * (y1_ - y0_ + 1);
  }
  /// Calls row(y) for every row, then texel(x, TexelPart) for every texel in it.
  template <typename Row, typename Texel>
  void for_each(const Row& row, const Texel& texel) const {
    for (int y = y0_; y <= y1_; ++y) {
      row(y);
      for (int x = x0_; x <= x1_; ++x) {
        const Vec2 offset{static_cast<float>(x) + 0.5f - centre_.x, static_cast<float>(y) + 0.5f - centre_.y};
        const Interval a = overlap(dot(to_a_, offset), half_a_), b = overlap(dot(to_b_, offset), half_b_);
        if (a.width <= 0 || b.width <= 0) continue;
        const TexelPart part{a.width * b.width, dx_ * a.shift + dy_ * b.shift, a.missing, b.missing};
        texel(wraps_u_ ? ((x % width_) + width_) % width_ : x, part);
      }
    }
  }

  /// Calls row(y, first x, last x) for every row.
  template <typename Row>
  void for_each_row(const Row& row) const {
    const int x0 = wraps_u_ ? ((x0_ % width_) + width_) % width_ : x0_;
    const int x1 = wraps_u_ ? ((x1_ % width_) + width_) % width_ : x1_;
    for (int y = y0_; y <= y1_ && x0_ <= x1_; ++y) row(y, x0, x1);
  }

 private:
  /// What [a - half, a + half] has in [-1/2, 1/2].
  struct Interval {
    float width, shift, missing;
  };
  static Interval overlap(float a, float half) {
    const float low = std::max(a - half, -0.5f), high = std::min(a + half, 0.5f), width = high - low;
    const float part = width / (2 * half);
    return {width, 0.5f * (low + high) - a, 1 - part * part};
  }

  bool wraps_u_;
  int width_, x0_, x1_, y0_, y1_;
  Vec2 centre_, dx_, dy_;  ///< middle and sides, in texels
  Vec2 to_a_, to_b_;       ///< texels to coordinates in which the footprint is the unit square
  float half_a_, half_b_;  ///< half the size of a texel there
};

}  // namespace redmap
