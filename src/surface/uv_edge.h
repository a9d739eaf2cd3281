// Exact edge functions: which side of a triangle's edge a place in the map lies on.
#pragma once

#include <cmath>
#include <utility>

namespace redmap {

/// A place in a map, in texels.
struct TexelPoint {
  double x, y;
};

/// A directed edge of a triangle in texels. Its ends are kept in an order of their own, so that the triangles on both
/// sides compute exactly opposite values and never leave a crack between them.
class UvEdge {
 public:
  UvEdge(TexelPoint a, TexelPoint b) : reversed_(b.x < a.x || (b.x == a.x && b.y < a.y)) {
    if (reversed_) std::swap(a, b);
    start_ = a, along_ = {b.x - a.x, b.y - a.y};
  }
  /// Twice the signed area of (a, b, p). The rounding is spelled out: it must not depend on what is inlined where.
  double side(TexelPoint p) const {
    const double area = std::fma(along_.x, p.y - start_.y, -(along_.y * (p.x - start_.x)));
    return reversed_ ? -area : area;
  }

 private:
  bool reversed_;
  TexelPoint start_, along_;
};

}  // namespace redmap
