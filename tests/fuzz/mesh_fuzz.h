// Mesh files: what is accepted holds what it promises, and goes on to become normals and parts.
#pragma once

#include <cmath>

#include "fuzz.h"
#include "surface/mesh.h"

namespace redmap::fuzz {

inline void require(bool holds) {
  if (!holds) __builtin_trap();
}

inline void require_sound(const TriangleMesh& mesh) {
  const auto in_range = [](const std::vector<Triangle>& triangles, std::size_t count) {
    for (const Triangle& triangle : triangles)
      for (const std::uint32_t index : triangle) require(index < count);
  };
  in_range(mesh.triangles, mesh.positions.size());
  in_range(mesh.normal_triangles, mesh.normals.size());
  in_range(mesh.uv_triangles, mesh.uv.size());
  for (const Vec3 position : mesh.positions) require(std::isfinite(dot(position, {1, 1, 1})));
  require(mesh.uv_triangles.empty() || mesh.uv_triangles.size() == mesh.triangles.size());
  require(mesh.normal_triangles.empty() || mesh.normal_triangles.size() == mesh.triangles.size());
}

inline int read_mesh_file(const std::string& name, const std::uint8_t* data, std::size_t size) {
  static InputFile file(name);
  return expect_result_or_error([&] {
    TriangleMesh mesh = read_mesh(file.holding(data, size));
    require_sound(mesh);
    part_names(mesh);
    compute_normals(mesh);
    require_sound(mesh);
  });
}

}  // namespace redmap::fuzz
