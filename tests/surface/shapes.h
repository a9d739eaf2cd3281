// Closed meshes with known properties for the tests of surfaces.
#pragma once

#include <cmath>
#include <map>
#include <utility>

#include "surface/mesh.h"

namespace redmap {

/// A unit icosahedron subdivided `levels` times, pushed out to the sphere: 20 * 4^levels triangles, counter-clockwise
/// from outside.
inline TriangleMesh icosphere(int levels) {
  const float t = (1 + std::sqrt(5.0f)) / 2;
  TriangleMesh mesh;
  mesh.positions = {{-1, t, 0},  {1, t, 0},  {-1, -t, 0}, {1, -t, 0}, {0, -1, t},  {0, 1, t},
                    {0, -1, -t}, {0, 1, -t}, {t, 0, -1},  {t, 0, 1},  {-t, 0, -1}, {-t, 0, 1}};
  mesh.triangles = {{0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
                    {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
                    {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}};
  for (Vec3& p : mesh.positions) p = normalized(p);
  for (int level = 0; level < levels; ++level) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles;
    const auto middle = [&](std::uint32_t a, std::uint32_t b) {
      const auto [found, is_new] = middles.try_emplace(std::minmax(a, b), mesh.positions.size());
      if (is_new) mesh.positions.push_back(normalized(mesh.positions[a] + mesh.positions[b]));
      return found->second;
    };
    std::vector<Triangle> finer;
    for (const auto& [a, b, c] : mesh.triangles) {
      const std::uint32_t ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
      finer.insert(finer.end(), {{a, ab, ca}, {b, bc, ab}, {c, ca, bc}, {ab, bc, ca}});
    }
    mesh.triangles = std::move(finer);
  }
  return mesh;
}

/// An icosphere with waves on it: closed, smooth, with hills and valleys as on a scanned animal.
inline TriangleMesh bumpy_sphere(int levels) {
  TriangleMesh mesh = icosphere(levels);
  for (Vec3& p : mesh.positions)
    p = p * (1 + 0.15f * std::sin(5 * p.x) * std::sin(4 * p.y + 1) * std::cos(3 * p.z) + 0.05f * std::sin(9 * p.y));
  return mesh;
}

/// A torus about the y axis of `around` x `across` quadrilaterals: genus 1, so no single chart can cover it.
inline TriangleMesh torus(std::uint32_t around, std::uint32_t across, float radius, float tube) {
  TriangleMesh mesh;
  for (std::uint32_t i = 0; i < around; ++i)
    for (std::uint32_t j = 0; j < across; ++j) {
      const float a = 2 * kPi * float(i) / float(around), b = 2 * kPi * float(j) / float(across);
      const float out = radius + tube * std::cos(b);
      mesh.positions.push_back({out * std::cos(a), tube * std::sin(b), out * std::sin(a)});
      const std::uint32_t i1 = (i + 1) % around, j1 = (j + 1) % across;
      const std::uint32_t p = i * across + j, q = i1 * across + j, r = i1 * across + j1, s = i * across + j1;
      mesh.triangles.push_back({p, r, q}), mesh.triangles.push_back({p, s, r});
    }
  return mesh;
}

/// The unit square at z = 0 with uv = (x, y), cut into 2 n^2 triangles.
inline TriangleMesh square(std::uint32_t n) {
  TriangleMesh mesh;
  for (std::uint32_t y = 0; y <= n; ++y)
    for (std::uint32_t x = 0; x <= n; ++x) {
      mesh.uv.push_back({float(x) / float(n), float(y) / float(n)});
      mesh.positions.push_back({mesh.uv.back().x, mesh.uv.back().y, 0});
    }
  for (std::uint32_t y = 0; y < n; ++y)
    for (std::uint32_t x = 0; x < n; ++x) {
      const std::uint32_t p = y * (n + 1) + x, q = p + 1, r = q + n + 1, s = p + n + 1;
      mesh.triangles.push_back({p, q, r}), mesh.triangles.push_back({p, r, s});
    }
  mesh.uv_triangles = mesh.triangles;
  return mesh;
}

}  // namespace redmap
