// Writes the inputs that fuzzers start from, one small file of every kind: make_seeds REPOSITORY FOLDER.
#include <fmt/format.h>

#include <fstream>
#include <iterator>

#include "bake/bake.h"
#include "base/atomic_file.h"
#include "map/map_description.h"
#include "map/map_file.h"
#include "surface/mesh.h"

namespace redmap {
namespace {

namespace fs = std::filesystem;

/// A folded square with uv and normals of its own.
TriangleMesh folded_square() {
  TriangleMesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0.5f}, {0, 1, 0}};
  mesh.uv = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  mesh.triangles = mesh.uv_triangles = {{0, 1, 2}, {0, 2, 3}};
  mesh.parts = {{"square", "paint"}};
  mesh.triangle_parts = {0, 0};
  compute_normals(mesh);
  return mesh;
}

void write(const fs::path& path, const std::string& bytes) {
  fs::create_directories(path.parent_path());
  write_file(path, bytes);
}

void write_stl(const fs::path& folder, const TriangleMesh& mesh) {
  std::string ascii = "solid square\n", binary(80, ' ');
  const auto count = static_cast<std::uint32_t>(mesh.triangles.size());
  binary.append(reinterpret_cast<const char*>(&count), sizeof count);
  for (const Triangle& triangle : mesh.triangles) {
    ascii += "facet normal 0 0 1\nouter loop\n";
    binary.append(sizeof(Vec3), '\0');
    for (const std::uint32_t index : triangle) {
      const Vec3 p = mesh.positions[index];
      ascii += fmt::format("vertex {} {} {}\n", p.x, p.y, p.z);
      binary.append(reinterpret_cast<const char*>(&p), sizeof p);
    }
    ascii += "endloop\nendfacet\n";
    binary.append(2, '\0');
  }
  write(folder / "ascii.stl", ascii + "endsolid square\n");
  write(folder / "binary.stl", binary);
}

constexpr const char* kAsciiPly =
    "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
    "property float s\nproperty float t\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n"
    "0 0 0 0 0\n1 0 0 1 0\n1 1 .5 1 1\n0 1 0 0 1\n4 0 1 2 3\n";

/// One triangle with uv, a camera and a light; `buffer`: how it names its 84 bytes.
std::string gltf_text(const std::string& buffer) {
  return R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0,1,2]}],
"nodes":[{"mesh":0,"scale":[2,2,2]},{"camera":0,"translation":[0,0,3]},{"extensions":{"KHR_lights_punctual":{"light":0}}}],
"cameras":[{"type":"perspective","perspective":{"yfov":0.7,"aspectRatio":1.5,"znear":0.1}}],
"extensionsUsed":["KHR_lights_punctual"],
"extensions":{"KHR_lights_punctual":{"lights":[{"type":"point","intensity":100}]}},
"materials":[{"name":"paint"}],
"meshes":[{"name":"triangle","primitives":[{"attributes":{"POSITION":0,"TEXCOORD_0":1},"indices":2,"material":0}]}],
"accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3","min":[0,0,0],"max":[1,1,0]},
{"bufferView":1,"componentType":5126,"count":3,"type":"VEC2"},
{"bufferView":2,"componentType":5125,"count":3,"type":"SCALAR"}],
"bufferViews":[{"buffer":0,"byteOffset":0,"byteLength":36},{"buffer":0,"byteOffset":36,"byteLength":24},
{"buffer":0,"byteOffset":60,"byteLength":12}],
"buffers":[{"byteLength":72)" +
         buffer + "}]}";
}

std::string base64(const std::string& bytes) {
  constexpr char kDigits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {  // 72 bytes: no padding
    const auto byte = [&](std::size_t k) {
      return static_cast<std::uint32_t>(static_cast<unsigned char>(bytes[i + k]));
    };
    const std::uint32_t bits = byte(0) << 16 | byte(1) << 8 | byte(2);
    for (const int shift : {18, 12, 6, 0}) text += kDigits[bits >> shift & 63];
  }
  return text;
}

void write_gltf(const fs::path& folder) {
  const float numbers[] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 1};
  const std::uint32_t indices[] = {0, 1, 2};
  std::string bytes(reinterpret_cast<const char*>(numbers), sizeof numbers);
  bytes.append(reinterpret_cast<const char*>(indices), sizeof indices);
  write(folder / "gltf" / "triangle.gltf",
        gltf_text(",\"uri\":\"data:application/octet-stream;base64," + base64(bytes) + "\""));

  std::string json = gltf_text("");
  json.resize((json.size() + 3) / 4 * 4, ' ');
  const auto word = [](std::size_t value) {
    const auto bits = static_cast<std::uint32_t>(value);
    return std::string(reinterpret_cast<const char*>(&bits), sizeof bits);
  };
  const std::string chunks = word(json.size()) + "JSON" + json + word(bytes.size()) + std::string("BIN\0", 4) + bytes;
  write(folder / "glb" / "triangle.glb", "glTF" + word(2) + word(12 + chunks.size()) + chunks);
}

void write_maps(const fs::path& folder) {
  BakeOptions options;
  options.size = 8, options.sub_samples = 2;
  const auto save = [&](const std::string& name, const Surface& surface, const std::string& shader) {
    const ReductionMap map = bake(surface, *make_library_shader(shader), options);
    fs::create_directories(folder / "map");
    write_map(folder / "map" / (name + ".exr"), map);
    write(folder / "map_description" / (name + ".json"), describe_map(map));
  };
  save("weights", *make_sphere(1), "noise");
  save("normals", *make_sphere(1), "ridges");
  save("clusters", *make_mesh_surface(folded_square()), "checker");
}

void copy_texts(const fs::path& from, const std::string& extension, const fs::path& to) {
  fs::create_directories(to);
  for (const fs::directory_entry& entry : fs::directory_iterator(from))
    if (entry.path().extension() == extension)
      fs::copy_file(entry.path(), to / entry.path().filename(), fs::copy_options::overwrite_existing);
}

void make_seeds(const fs::path& repository, const fs::path& folder) {
  const TriangleMesh mesh = folded_square();
  fs::create_directories(folder / "obj"), fs::create_directories(folder / "ply");
  write_mesh(folder / "obj" / "square.obj", mesh);
  write_mesh(folder / "ply" / "binary.ply", mesh);
  write(folder / "ply" / "ascii.ply", kAsciiPly);
  write_stl(folder / "stl", mesh);
  write_gltf(folder);
  write_maps(folder);
  copy_texts(repository / "scenes", ".toml", folder / "scene");
  copy_texts(repository / "src/shader/library", ".glsl", folder / "shader_text");
  copy_texts(repository / "docs/examples", ".glsl", folder / "shader_text");
  write(folder / "frame_spec" / "ranges", "1-300,310,320-400:2");
  write(folder / "frame_spec" / "pattern", "out.####.png");
  write(folder / "overrides" / "parameter", "ball.scale=[1, 2.5, -3e2]");
  write(folder / "overrides" / "key", "object.ball.map_size=512");
}

}  // namespace
}  // namespace redmap

int main(int argc, char** argv) {
  if (argc != 3) return 1;
  redmap::make_seeds(argv[1], argv[2]);
  return 0;
}
