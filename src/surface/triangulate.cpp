// Ear clipping (Meisters 1975) in the plane of Newell's normal: quadratic, and polygons of files are small.
#include "surface/triangulate.h"

#include <numeric>

namespace redmap {

namespace {

/// Twice the area vector of a polygon, also of one that is not plane (Newell).
Vec3 area_vector(std::span<const Vec3> corners) {
  Vec3 sum;
  for (std::size_t i = 1; i + 1 < corners.size(); ++i)
    sum += cross(corners[i] - corners[0], corners[i + 1] - corners[0]);
  return sum;
}

/// Whether the triangle turns as the polygon does.
bool is_convex(Vec3 a, Vec3 b, Vec3 c, Vec3 normal) { return dot(cross(b - a, c - a), normal) > 0; }

void cut_quadrilateral(std::span<const Vec3> p, std::vector<std::array<int, 3>>& triangles) {
  const Vec3 normal = area_vector(p);
  const auto lies_inside = [&](int a) {
    const int b = (a + 1) % 4, c = (a + 2) % 4, d = (a + 3) % 4;
    return is_convex(p[a], p[b], p[c], normal) && is_convex(p[a], p[c], p[d], normal);
  };
  const bool shorter02 = length(p[2] - p[0]) < length(p[3] - p[1]);
  const bool cut02 = shorter02 ? lies_inside(0) || !lies_inside(1) : lies_inside(0) && !lies_inside(1);
  if (cut02)
    triangles = {{0, 1, 2}, {0, 2, 3}};
  else
    triangles = {{0, 1, 3}, {1, 2, 3}};
}

bool is_ear(std::span<const Vec3> p, std::span<const int> left, std::size_t i, Vec3 normal) {
  const std::size_t n = left.size();
  const std::size_t before = (i + n - 1) % n, after = (i + 1) % n;
  const Vec3 a = p[left[before]], b = p[left[i]], c = p[left[after]];
  if (!is_convex(a, b, c, normal)) return false;
  for (std::size_t j = 0; j < n; ++j) {
    if (j == before || j == i || j == after) continue;
    const Vec3 q = p[left[j]];
    // Where a polygon touches itself, to cut a hole, corners repeat: they are in nobody's way.
    if (q == a || q == b || q == c) continue;
    if (!is_convex(b, a, q, normal) && !is_convex(c, b, q, normal) && !is_convex(a, c, q, normal)) return false;
  }
  return true;
}

}  // namespace

void triangulate(std::span<const Vec3> corners, std::vector<std::array<int, 3>>& triangles) {
  triangles.clear();
  if (corners.size() == 4) return cut_quadrilateral(corners, triangles);
  const Vec3 normal = area_vector(corners);
  std::vector<int> left(corners.size());
  std::iota(left.begin(), left.end(), 0);
  while (left.size() > 3) {
    std::size_t ear = 0;
    while (ear < left.size() && !is_ear(corners, left, ear, normal)) ++ear;
    // No ear: the polygon crosses itself, and any corner is as good.
    if (ear == left.size()) ear = 1;
    const std::size_t n = left.size();
    triangles.push_back({left[(ear + n - 1) % n], left[ear], left[(ear + 1) % n]});
    left.erase(left.begin() + static_cast<std::ptrdiff_t>(ear));
  }
  if (left.size() == 3) triangles.push_back({left[0], left[1], left[2]});
}

}  // namespace redmap
