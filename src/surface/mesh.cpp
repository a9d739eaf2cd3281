// What is common to all mesh files: validation, zero-area triangles, vertex normals; and writing.
#include "surface/mesh.h"

#include <fmt/os.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <fstream>
#include <iterator>

#include "base/error.h"
#include "surface/mesh_files.h"

namespace redmap {

namespace {

std::string lower_extension(const std::filesystem::path& path) {
  std::string extension = path.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return std::tolower(c); });
  return extension;
}

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

bool has_area(const TriangleMesh& mesh, const Triangle& t) {
  const Vec3 a = mesh.positions[t[0]], b = mesh.positions[t[1]], c = mesh.positions[t[2]];
  const Vec3 normal = cross(b - a, c - a);
  // So thin that float cannot give it a normal counts as no area.
  return std::isnormal(dot(normal, normal));
}

std::size_t drop_zero_area(TriangleMesh& mesh) {
  std::size_t kept = 0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    if (!has_area(mesh, mesh.triangles[t])) continue;
    mesh.triangles[kept] = mesh.triangles[t];
    if (!mesh.normal_triangles.empty()) mesh.normal_triangles[kept] = mesh.normal_triangles[t];
    if (!mesh.uv_triangles.empty()) mesh.uv_triangles[kept] = mesh.uv_triangles[t];
    ++kept;
  }
  const std::size_t dropped = mesh.triangles.size() - kept;
  mesh.triangles.resize(kept);
  if (!mesh.normal_triangles.empty()) mesh.normal_triangles.resize(kept);
  if (!mesh.uv_triangles.empty()) mesh.uv_triangles.resize(kept);
  return dropped;
}

void write_obj(fmt::ostream& out, const TriangleMesh& mesh) {
  for (const Vec3 p : mesh.positions) out.print("v {} {} {}\n", p.x, p.y, p.z);
  for (const Vec2 t : mesh.uv) out.print("vt {} {}\n", t.x, t.y);
  for (const Vec3 n : mesh.normals) out.print("vn {} {} {}\n", n.x, n.y, n.z);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    out.print("f");
    for (int k = 0; k < 3; ++k) {
      out.print(" {}", mesh.triangles[t][k] + 1);
      if (!mesh.uv_triangles.empty()) out.print("/{}", mesh.uv_triangles[t][k] + 1);
      if (!mesh.normal_triangles.empty())
        out.print("{}{}", mesh.uv_triangles.empty() ? "//" : "/", mesh.normal_triangles[t][k] + 1);
    }
    out.print("\n");
  }
}

template <typename T>
void put(std::string& bytes, const T& value) {
  bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

/// Positions and faces; uv a corner, as MeshLab and Blender read them.
std::string ply_bytes(const TriangleMesh& mesh) {
  const bool has_uv = !mesh.uv_triangles.empty();
  std::string bytes = fmt::format(
      "ply\nformat binary_little_endian 1.0\nelement vertex {}\nproperty float x\nproperty float y\nproperty float z\n"
      "element face {}\nproperty list uchar int vertex_indices\n{}end_header\n",
      mesh.positions.size(), mesh.triangles.size(), has_uv ? "property list uchar float texcoord\n" : "");
  for (const Vec3 p : mesh.positions) put(bytes, p);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    put(bytes, std::uint8_t{3});
    put(bytes, mesh.triangles[t]);
    if (!has_uv) continue;
    put(bytes, std::uint8_t{6});
    for (const std::uint32_t corner : mesh.uv_triangles[t]) put(bytes, mesh.uv[corner]);
  }
  return bytes;
}

}  // namespace

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

TriangleMesh read_mesh(const std::filesystem::path& path, MeshReport* report) {
  const std::string extension = lower_extension(path);
  TriangleMesh mesh;
  if (extension == ".obj")
    mesh = read_obj(path);
  else if (extension == ".ply")
    mesh = read_ply(path);
  else if (extension == ".gltf" || extension == ".glb")
    mesh = read_gltf(path, extension == ".glb");
  else
    throw Error("{}: expected a mesh as .obj, .ply, .gltf or .glb, found \"{}\"", path.string(), extension);
  check(path, mesh);
  const std::size_t dropped = drop_zero_area(mesh);
  if (mesh.triangles.empty())
    throw Error("{}: expected a mesh, found only the {} zero-area triangles", path.string(), dropped);
  if (report) report->zero_area_triangles = dropped;
  return mesh;
}

void write_mesh(const std::filesystem::path& path, const TriangleMesh& mesh) {
  const std::string extension = lower_extension(path);
  if (extension != ".obj" && extension != ".ply")
    throw Error("{}: meshes are written as .obj or .ply, found \"{}\"", path.string(), extension);
  const std::filesystem::path temporary = path.string() + ".tmp";
  try {
    if (extension == ".obj") {
      fmt::ostream out = fmt::output_file(temporary.string());
      write_obj(out, mesh);
      out.close();
    } else {
      std::ofstream out(temporary, std::ios::binary);
      out.exceptions(std::ios::failbit | std::ios::badbit);
      const std::string bytes = ply_bytes(mesh);
      out.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
      out.close();
    }
    std::filesystem::rename(temporary, path);
  } catch (const std::exception& error) {
    std::error_code ignored;
    std::filesystem::remove(temporary, ignored);
    throw Error("{}: cannot be written: {}", path.string(), error.what());
  }
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
