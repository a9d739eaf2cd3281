#include "export/mesh_buffers.h"

#include <map>

#include "surface/mesh.h"

namespace redmap {

namespace {

// Of an analytic surface, around and from end to end: quads of .94 degrees. Twice as wide, narrow highlights between
// bumps come out .0071 (RMSE) from the analytic sphere's, so .0038, with half of it .0025 (docs/results.md).
constexpr int kColumns = 384, kRows = 192;

std::array<float, 3> array_of(Vec3 v) { return {v.x, v.y, v.z}; }

void add_vertex(Vec3 position, Vec3 normal, Vec3 tangent, Vec2 uv, std::size_t triangle, MeshBuffers& mesh) {
  mesh.triangles.push_back(static_cast<std::uint32_t>(triangle));
  mesh.positions.push_back(array_of(position)), mesh.normals.push_back(array_of(normal));
  mesh.tangents.push_back({tangent.x, tangent.y, tangent.z, 1});
  mesh.uv.push_back({uv.x, uv.y});
}

MeshBuffers grid_of(const Surface& surface) {
  MeshBuffers mesh;
  std::vector<HitCoordinates> where;
  for (int j = 0; j <= kRows; ++j)
    for (int i = 0; i <= kColumns; ++i)
      where.push_back({0, {static_cast<float>(i) / kColumns, static_cast<float>(j) / kRows}});
  std::vector<SurfaceHit> hits(where.size());
  surface.complete(where, hits);
  for (std::size_t i = 0; i < hits.size(); ++i)
    add_vertex(hits[i].position, hits[i].normal, hits[i].tangent, where[i].coordinates, 0, mesh);
  for (std::uint32_t j = 0; j < kRows; ++j)
    for (std::uint32_t i = 0; i < kColumns; ++i) {
      const std::uint32_t a = j * (kColumns + 1) + i, b = a + 1, c = a + kColumns + 1, d = c + 1;
      // Counter-clockwise from outside; at a pole of a sphere one of the two has no area.
      const auto add = [&](std::uint32_t p, std::uint32_t q, std::uint32_t r) {
        const Vec3 face = cross(hits[q].position - hits[p].position, hits[r].position - hits[p].position);
        if (dot(face, face) <= 0) return;
        const bool outward = dot(face, hits[p].normal + hits[q].normal + hits[r].normal) > 0;
        mesh.indices.insert(mesh.indices.end(), {p, outward ? q : r, outward ? r : q});
      };
      add(a, b, d), add(a, d, c);
    }
  return mesh;
}

/// Change of position with u over a triangle.
Vec3 along_u(const TriangleMesh& mesh, std::size_t t) {
  const auto& p = mesh.triangles[t];
  const auto& q = mesh.uv_triangles[t];
  const Vec3 e1 = mesh.positions[p[1]] - mesh.positions[p[0]], e2 = mesh.positions[p[2]] - mesh.positions[p[0]];
  const Vec2 t1 = mesh.uv[q[1]] - mesh.uv[q[0]], t2 = mesh.uv[q[2]] - mesh.uv[q[0]];
  const float determinant = cross(t1, t2);
  return determinant != 0 ? (e1 * t2.y - e2 * t1.y) / determinant : e1;
}

MeshBuffers vertices_of(const TriangleMesh& mesh) {
  MeshBuffers all;
  std::map<std::array<std::uint32_t, 3>, std::uint32_t> known;
  std::vector<Vec3> tangents;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    for (int k = 0; k < 3; ++k) {
      const std::array<std::uint32_t, 3> key{mesh.triangles[t][k], mesh.normal_triangles[t][k],
                                             mesh.uv_triangles[t][k]};
      const auto [found, is_new] = known.try_emplace(key, static_cast<std::uint32_t>(tangents.size()));
      if (is_new) {
        add_vertex(mesh.positions[key[0]], normalized(mesh.normals[key[1]]), {}, mesh.uv[key[2]], t, all);
        tangents.push_back({});
      }
      all.indices.push_back(found->second);
      tangents[found->second] += normalized(along_u(mesh, t));
    }
  for (std::size_t i = 0; i < tangents.size(); ++i) {
    auto& n = all.normals[i];
    if (n[0] == 0 && n[1] == 0 && n[2] == 0) n = {0, 0, 1};
    const Vec3 tangent = make_frame({n[0], n[1], n[2]}, tangents[i]).x;
    all.tangents[i] = {tangent.x, tangent.y, tangent.z, 1};
  }
  return all;
}

}  // namespace

MeshBuffers mesh_buffers(const Surface& surface) {
  MeshBuffers mesh = surface.mesh() ? vertices_of(*surface.mesh()) : grid_of(surface);
  mesh.lower = mesh.upper = {mesh.positions[0][0], mesh.positions[0][1], mesh.positions[0][2]};
  for (const auto& p : mesh.positions)
    for (int c = 0; c < 3; ++c)
      mesh.lower[c] = std::min(mesh.lower[c], p[c]), mesh.upper[c] = std::max(mesh.upper[c], p[c]);
  return mesh;
}

std::string mesh_bytes(const MeshBuffers& mesh) {
  std::string bytes;
  const auto append = [&](const auto* values, std::size_t count) {
    bytes.append(reinterpret_cast<const char*>(values), count * sizeof(*values));
  };
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    append(mesh.positions[i].data(), 3), append(mesh.normals[i].data(), 3);
    append(mesh.tangents[i].data(), 3), append(mesh.uv[i].data(), 2);
    const float triangle = static_cast<float>(mesh.triangles[i]);
    append(&triangle, 1);
  }
  append(mesh.indices.data(), mesh.indices.size());
  return bytes;
}

}  // namespace redmap
