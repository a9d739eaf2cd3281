// Writing meshes: OBJ with everything, PLY with positions and uv.
#include <fmt/os.h>

#include <fstream>

#include "base/error.h"
#include "surface/mesh_files.h"

namespace redmap {

namespace {

/// The lines that start a part, where triangle `t` does.
void write_part(fmt::ostream& out, const TriangleMesh& mesh, std::size_t t) {
  if (mesh.triangle_parts.empty() || (t > 0 && mesh.triangle_parts[t] == mesh.triangle_parts[t - 1])) return;
  const MeshPart& part = mesh.parts[mesh.triangle_parts[t]];
  out.print("g {}\nusemtl {}\n", part.group, part.material);
}

void write_obj(fmt::ostream& out, const TriangleMesh& mesh) {
  for (const Vec3 p : mesh.positions) out.print("v {} {} {}\n", p.x, p.y, p.z);
  for (const Vec2 t : mesh.uv) out.print("vt {} {}\n", t.x, t.y);
  for (const Vec3 n : mesh.normals) out.print("vn {} {} {}\n", n.x, n.y, n.z);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    write_part(out, mesh, t);
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

}  // namespace redmap
