// What is common to all mesh files: validation, zero-area triangles, parts, vertex normals.
#include "surface/mesh.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <fstream>
#include <iterator>
#include <limits>

#include "base/error.h"
#include "base/nearest.h"
#include "surface/mesh_files.h"

namespace redmap {

namespace {

void check_indices(const std::filesystem::path& path, const char* what, const std::vector<Triangle>& triangles,
                   std::size_t count) {
  for (std::size_t t = 0; t < triangles.size(); ++t)
    for (const std::uint32_t index : triangles[t])
      if (index >= count)
        throw Error("{}: triangle {}: expected a {} index below {}, found {}", path.string(), t, what, count, index);
}

void check(const std::filesystem::path& path, const TriangleMesh& mesh) {
  if (mesh.positions.empty()) throw Error("{}: expected a mesh, found no vertices", path.string());
  if (mesh.triangles.empty()) throw Error("{}: expected a mesh, found no faces", path.string());
  check_indices(path, "vertex", mesh.triangles, mesh.positions.size());
  check_indices(path, "normal", mesh.normal_triangles, mesh.normals.size());
  check_indices(path, "uv", mesh.uv_triangles, mesh.uv.size());
  // Beyond this, areas and squared lengths leave the range of floats.
  constexpr float kLargest = 1e15f;
  for (std::size_t i = 0; i < mesh.positions.size(); ++i)
    for (int axis = 0; axis < 3; ++axis)
      if (!(std::abs(mesh.positions[i][axis]) <= kLargest))
        throw Error("{}: vertex {}: expected finite coordinates up to {}, found ({}, {}, {})", path.string(), i,
                    kLargest, mesh.positions[i].x, mesh.positions[i].y, mesh.positions[i].z);
  for (std::size_t i = 0; i < mesh.uv.size(); ++i)
    if (!std::isfinite(mesh.uv[i].x) || !std::isfinite(mesh.uv[i].y))
      throw Error("{}: uv {}: expected finite values, found ({}, {})", path.string(), i, mesh.uv[i].x, mesh.uv[i].y);
  for (std::size_t i = 0; i < mesh.normals.size(); ++i)
    if (!std::isfinite(dot(mesh.normals[i], mesh.normals[i])))
      throw Error("{}: normal {}: expected finite values, found ({}, {}, {})", path.string(), i, mesh.normals[i].x,
                  mesh.normals[i].y, mesh.normals[i].z);
}

/// In double: the products of float cancel to anything where a triangle is thin.
bool has_area(const TriangleMesh& mesh, const Triangle& t) {
  std::array<double, 3> edge[3];
  double longest = 0, squared_area = 0;
  for (int k = 0; k < 3; ++k) {
    const Vec3 from = mesh.positions[t[k]], to = mesh.positions[t[(k + 1) % 3]];
    edge[k] = {double(to.x) - from.x, double(to.y) - from.y, double(to.z) - from.z};
    longest = std::max(longest, std::hypot(edge[k][0], edge[k][1], edge[k][2]));
  }
  for (int axis = 0; axis < 3; ++axis) {
    const int i = (axis + 1) % 3, j = (axis + 2) % 3;
    const double normal = edge[0][i] * edge[1][j] - edge[0][j] * edge[1][i];
    squared_area += normal * normal;
  }
  // A height below the rounding of float beside the longest side, or a normal beyond its range, is none.
  return std::sqrt(squared_area) > std::numeric_limits<float>::epsilon() * longest * longest &&
         squared_area > std::numeric_limits<float>::min();
}

std::vector<std::uint8_t> triangles_with_area(const TriangleMesh& mesh) {
  std::vector<std::uint8_t> keep(mesh.triangles.size());
  for (std::size_t t = 0; t < keep.size(); ++t) keep[t] = has_area(mesh, mesh.triangles[t]);
  return keep;
}

/// As the file has it, checked.
TriangleMesh read_whole(const std::filesystem::path& path, const std::vector<Vec3>* shape, int uv_set,
                        MeshReport* report) {
  const std::string extension = lower_extension(path);
  TriangleMesh mesh;
  std::vector<std::string> not_applied;
  if (extension == ".obj")
    mesh = read_obj(path, shape);
  else if (extension == ".ply")
    mesh = read_ply(path, shape);
  else if (extension == ".stl")
    mesh = read_stl(path);
  else if (extension == ".gltf" || extension == ".glb")
    mesh = read_gltf(path, extension == ".glb", uv_set, not_applied);
  else
    throw Error("{}: expected a mesh as .obj, .ply, .stl, .gltf or .glb, found \"{}\"", path.string(), extension);
  if (report) std::move(not_applied.begin(), not_applied.end(), std::back_inserter(report->not_applied));
  check(path, mesh);
  const bool is_named = mesh.parts.size() > 1 ||
                        (mesh.parts.size() == 1 && !(mesh.parts[0].group.empty() && mesh.parts[0].material.empty()));
  if (!is_named) mesh.parts.clear(), mesh.triangle_parts.clear();
  return mesh;
}

/// Which triangles to keep: those with area. Throws Error if none has any.
std::vector<std::uint8_t> check_areas(const std::filesystem::path& path, const TriangleMesh& mesh, MeshReport* report) {
  std::vector<std::uint8_t> keep = triangles_with_area(mesh);
  const auto dropped = static_cast<std::size_t>(std::count(keep.begin(), keep.end(), 0));
  if (dropped == keep.size())
    throw Error("{}: expected a mesh, found only the {} zero-area triangles", path.string(), dropped);
  if (report) report->zero_area_triangles = dropped;
  return keep;
}

}  // namespace

std::string lower_extension(const std::filesystem::path& path) {
  std::string extension = path.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return std::tolower(c); });
  return extension;
}

std::string read_bytes(const std::filesystem::path& path) {
  std::error_code error;
  if (!std::filesystem::exists(path, error)) throw Error("{}: no such file", path.string());
  if (!std::filesystem::is_regular_file(path, error))
    throw Error("{}: expected a file, found something else", path.string());
  std::ifstream in(path, std::ios::binary);
  std::string bytes{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
  if (in.bad() || !in.is_open()) throw Error("{}: cannot be read", path.string());
  if (bytes.empty()) throw Error("{}: expected a mesh, found an empty file", path.string());
  return bytes;
}

TriangleMesh read_mesh(const std::filesystem::path& path, MeshReport* report, int uv_set) {
  TriangleMesh mesh = read_whole(path, nullptr, uv_set, report);
  keep_triangles(mesh, check_areas(path, mesh, report));
  return mesh;
}

PosedMesh read_posed_mesh(const std::filesystem::path& rest, const std::filesystem::path& posed, MeshReport* report,
                          int uv_set) {
  PosedMesh mesh;
  mesh.rest = read_whole(rest, nullptr, uv_set, report);
  mesh.posed = read_whole(posed, &mesh.rest.positions, uv_set, report);
  const auto differ = [&](const char* what, std::size_t expected, std::size_t found) {
    throw Error("{}: expected {} {} as in the mesh at rest, {}, found {}", posed.string(), expected, what,
                rest.string(), found);
  };
  if (mesh.posed.positions.size() != mesh.rest.positions.size())
    differ("vertices", mesh.rest.positions.size(), mesh.posed.positions.size());
  if (mesh.posed.triangles.size() != mesh.rest.triangles.size())
    differ("triangles", mesh.rest.triangles.size(), mesh.posed.triangles.size());
  for (std::size_t t = 0; t < mesh.rest.triangles.size(); ++t)
    if (mesh.posed.triangles[t] != mesh.rest.triangles[t])
      throw Error("{}: expected the topology of the mesh at rest, {}, found that triangle {} has other vertices",
                  posed.string(), rest.string(), t);
  const std::vector<std::uint8_t> keep = check_areas(rest, mesh.rest, report);
  keep_triangles(mesh.rest, keep), keep_triangles(mesh.posed, keep);
  return mesh;
}

void keep_triangles(TriangleMesh& mesh, std::span<const std::uint8_t> keep) {
  const auto filter = [&](auto& values) {
    std::size_t kept = 0;
    for (std::size_t t = 0; t < values.size(); ++t)
      if (keep[t]) values[kept++] = values[t];
    values.resize(kept);
  };
  filter(mesh.triangles), filter(mesh.normal_triangles), filter(mesh.uv_triangles), filter(mesh.triangle_parts);
}

void drop_unused_vertices(TriangleMesh& mesh) {
  const auto compact = [](std::vector<Vec3>& values, std::vector<Triangle>& triangles) {
    constexpr std::uint32_t kUnused = ~0u;
    std::vector<std::uint32_t> place(values.size(), kUnused);
    std::vector<Vec3> used;
    for (Triangle& t : triangles)
      for (std::uint32_t& index : t) {
        if (place[index] == kUnused) {
          place[index] = static_cast<std::uint32_t>(used.size());
          used.push_back(values[index]);
        }
        index = place[index];
      }
    values = std::move(used);
  };
  compact(mesh.positions, mesh.triangles);
  compact(mesh.normals, mesh.normal_triangles);
}

std::vector<std::string> part_names(const TriangleMesh& mesh) {
  std::vector<std::string> names;
  const auto add = [&](const std::string& name) {
    if (!name.empty() && std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
  };
  for (const MeshPart& part : mesh.parts) add(part.group);
  for (const MeshPart& part : mesh.parts) add(part.material);
  return names;
}

std::vector<std::uint8_t> select_part(const TriangleMesh& mesh, const std::string& name) {
  std::vector<std::uint8_t> keep(mesh.triangles.size());
  for (std::size_t t = 0; t < mesh.triangle_parts.size(); ++t) {
    const MeshPart& part = mesh.parts[mesh.triangle_parts[t]];
    keep[t] = part.group == name || part.material == name;
  }
  if (std::find(keep.begin(), keep.end(), 1) != keep.end()) return keep;
  const std::vector<std::string> names = part_names(mesh);
  if (names.empty()) throw Error("expected a part of the mesh, found \"{}\" for a mesh without named parts", name);
  throw Error("expected a part of the mesh, found \"{}\" (did you mean \"{}\"?)", name, nearest(name, names));
}

void compute_normals(TriangleMesh& mesh) {
  mesh.normals.assign(mesh.positions.size(), {});
  mesh.normal_triangles = mesh.triangles;
  for (const Triangle& t : mesh.triangles) {
    const Vec3 a = mesh.positions[t[0]], b = mesh.positions[t[1]], c = mesh.positions[t[2]];
    const Vec3 weighted = cross(b - a, c - a);
    for (const std::uint32_t vertex : t) mesh.normals[vertex] += weighted;
  }
  for (Vec3& normal : mesh.normals) normal = normalized(normal);
}

}  // namespace redmap
