#include "gpu/triangle_tree.h"

#include <algorithm>
#include <bit>
#include <numeric>
#include <span>

namespace redmap {
namespace {

/// Boxes are wider by this part of their largest coordinate: roundings of a ray that grazes one.
constexpr float kMargin = 4e-6f;

struct Box {
  Vec3 lower{1e30f, 1e30f, 1e30f}, upper{-1e30f, -1e30f, -1e30f};

  void add(Vec3 p) {
    for (int axis = 0; axis < 3; ++axis)
      lower[axis] = std::min(lower[axis], p[axis]), upper[axis] = std::max(upper[axis], p[axis]);
  }
  int longest_axis() const {
    const Vec3 size = upper - lower;
    return size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
  }
  Box widened() const {
    float largest = 0;
    for (int axis = 0; axis < 3; ++axis) largest = std::max({largest, std::abs(lower[axis]), std::abs(upper[axis])});
    const Vec3 margin = Vec3{1, 1, 1} * (kMargin * largest);
    return {lower - margin, upper + margin};
  }
};

class TreeBuilder {
 public:
  explicit TreeBuilder(const TriangleMesh& mesh) : mesh_(mesh), order_(mesh.triangles.size()) {
    std::iota(order_.begin(), order_.end(), 0u);
    nodes_.reserve(4 * order_.size());
    add(order_);
  }
  std::vector<Vec4> nodes() && { return std::move(nodes_); }

 private:
  Vec3 centre(std::uint32_t t) const {
    const auto& corners = mesh_.triangles[t];
    return mesh_.positions[corners[0]] + mesh_.positions[corners[1]] + mesh_.positions[corners[2]];
  }

  /// Halves `triangles` across the longest side of what their centres take up, down to one.
  void add(std::span<std::uint32_t> triangles) {
    const std::size_t at = nodes_.size();
    nodes_.resize(at + 2);
    Box box, centres;
    for (const std::uint32_t t : triangles) {
      for (const std::uint32_t corner : mesh_.triangles[t]) box.add(mesh_.positions[corner]);
      centres.add(centre(t));
    }
    std::uint32_t triangle = ~0u;
    if (triangles.size() == 1) {
      triangle = triangles.front();
    } else {
      const std::size_t half = triangles.size() / 2;
      const int axis = centres.longest_axis();
      std::nth_element(triangles.begin(), triangles.begin() + half, triangles.end(),
                       [&](std::uint32_t a, std::uint32_t b) { return centre(a)[axis] < centre(b)[axis]; });
      add(triangles.first(half)), add(triangles.subspan(half));
    }
    const Box wide = box.widened();
    nodes_[at] = {wide.lower, std::bit_cast<float>(static_cast<std::uint32_t>(nodes_.size() / 2))};
    nodes_[at + 1] = {wide.upper, std::bit_cast<float>(triangle)};
  }

  const TriangleMesh& mesh_;
  std::vector<std::uint32_t> order_;
  std::vector<Vec4> nodes_;
};

}  // namespace

std::vector<Vec4> triangle_tree(const TriangleMesh& mesh) { return TreeBuilder(mesh).nodes(); }

}  // namespace redmap
