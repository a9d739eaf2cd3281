// Mesh files: what is written comes back, three formats agree, and hostile files end in one clear line.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>

#include "base/error.h"
#include "shapes.h"
#include "temporary_folder.h"

namespace redmap {
namespace {

using testing::HasSubstr;

std::string error_of(const std::filesystem::path& path) {
  try {
    read_mesh(path);
  } catch (const Error& error) {
    EXPECT_THAT(error.what(), HasSubstr(path.filename().string())) << "the error names the file";
    EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << "the error is one line";
    return error.what();
  }
  return "no error";
}

template <typename T>
void append(std::string& bytes, T value, bool swap = false) {
  char raw[sizeof(T)];
  std::memcpy(raw, &value, sizeof value);
  if (swap) std::reverse(raw, raw + sizeof value);
  bytes.append(raw, sizeof raw);
}

const char* const kTriangleObj = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";

TEST(MeshFiles, ObjAndPlyComeBackAsTheyWere) {
  const TemporaryFolder folder;
  TriangleMesh mesh = square(3);
  compute_normals(mesh);
  for (const char* name : {"square.obj", "square.ply"}) {
    write_mesh(folder / name, mesh);
    const TriangleMesh back = read_mesh(folder / name);
    EXPECT_EQ(back.positions, mesh.positions) << name;
    EXPECT_EQ(back.triangles, mesh.triangles) << name;
    ASSERT_EQ(back.uv_triangles.size(), mesh.uv_triangles.size()) << name;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
      for (int k = 0; k < 3; ++k) EXPECT_EQ(back.uv[back.uv_triangles[t][k]], mesh.uv[mesh.uv_triangles[t][k]]) << name;
  }
  EXPECT_EQ(read_mesh(folder / "square.obj").normals, mesh.normals);
  EXPECT_FALSE(std::filesystem::exists(folder / "square.obj.tmp"));
}

TEST(MeshFiles, ObjPolygonsNegativeIndicesAndSeparateUvAreUnderstood) {
  const TemporaryFolder folder;
  const auto path = folder.write("quad.obj",
                                 "# a unit square\r\nv 0 0 0\r\nv 1 0 0\r\nv 1 1 0\r\nv 0 1 0\r\n"
                                 "vt 0 0\nvt 1 1\nvt .5 .5\nf -4/1 -3/3 -2/2 -1/3\n");
  const TriangleMesh mesh = read_mesh(path);
  ASSERT_EQ(mesh.triangles.size(), 2u);
  EXPECT_EQ(mesh.positions.size(), 4u);
  EXPECT_EQ(mesh.uv.size(), 3u);
  for (std::size_t t = 0; t < 2; ++t)
    for (int k = 0; k < 3; ++k) {
      const std::uint32_t expected[] = {0, 2, 1, 2};
      EXPECT_EQ(mesh.uv_triangles[t][k], expected[mesh.triangles[t][k]]);
    }
}

TEST(MeshFiles, UvOnSomeFacesOnlyAreNoAtlas) {
  const TemporaryFolder folder;
  const auto path = folder.write("half.obj", std::string(kTriangleObj) + "vt 0 0\nf 1/1 2/1 3/1\nf 1 3 2\n");
  EXPECT_TRUE(read_mesh(path).uv_triangles.empty());
}

TEST(MeshFiles, ZeroAreaTrianglesAreDroppedAndCounted) {
  const TemporaryFolder folder;
  const auto path = folder.write("thin.obj", std::string(kTriangleObj) + "v 2 0 0\nf 1 2 3\nf 1 1 3\nf 1 2 4\n");
  MeshReport report;
  EXPECT_EQ(read_mesh(path, &report).triangles.size(), 1u);
  EXPECT_EQ(report.zero_area_triangles, 2u);
  EXPECT_THAT(error_of(folder.write("none.obj", std::string(kTriangleObj) + "f 1 1 2\n")), HasSubstr("zero-area"));
}

TEST(MeshFiles, AreasAreJudgedInDouble_CollinearPointsHaveNoneAndThinTrianglesDo) {
  const TemporaryFolder folder;
  // Multiples of one point: in float the products of their differences do not cancel.
  const auto flat = folder.write(
      "flat.obj", "v 0.1 0.3 0.7\nv 0.2 0.6 1.4\nv 0.4 1.2 2.8\nv 1 0 0\nv 1 1e4 0\nv 1.01 5e3 0\nf 1 2 3\nf 4 5 6\n");
  MeshReport report;
  const TriangleMesh mesh = read_mesh(flat, &report);
  EXPECT_EQ(report.zero_area_triangles, 1u);
  ASSERT_EQ(mesh.triangles.size(), 1u);
  EXPECT_EQ(mesh.triangles[0][0], 3u);
}

/// A tetrahedron as PLY, with an element to skip and every scalar kind on the way.
std::string ply_tetrahedron(bool ascii, bool big_endian) {
  std::string text = std::string("ply\nformat ") +
                     (ascii        ? "ascii"
                      : big_endian ? "binary_big_endian"
                                   : "binary_little_endian") +
                     " 1.0\ncomment made here\nelement camera 1\nproperty list uint8 short things\n"
                     "element vertex 4\nproperty double x\nproperty float y\nproperty float z\nproperty uchar red\n"
                     "element face 4\nproperty list uchar int vertex_indices\nend_header\n";
  const float p[4][3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, -1.5f}};
  const int f[4][3] = {{0, 1, 2}, {0, 3, 1}, {1, 3, 2}, {2, 3, 0}};
  if (ascii) {
    text += "2 7 -8\n0 0 0 255\n1 0 0 255\n0 1 0 255\n0 0 -1.5 255\n3 0 1 2\n3 0 3 1\n3 1 3 2\n3 2 3 0\n";
    return text;
  }
  append<std::uint8_t>(text, 2);
  append<std::int16_t>(text, 7, big_endian), append<std::int16_t>(text, -8, big_endian);
  for (const auto& v : p) {
    append<double>(text, v[0], big_endian);
    append(text, v[1], big_endian), append(text, v[2], big_endian), append<std::uint8_t>(text, 255);
  }
  for (const auto& t : f) {
    append<std::uint8_t>(text, 3);
    for (const int index : t) append(text, index, big_endian);
  }
  return text;
}

TEST(MeshFiles, ThreeKindsOfPlyAgree) {
  const TemporaryFolder folder;
  const TriangleMesh ascii = read_mesh(folder.write("a.ply", ply_tetrahedron(true, false)));
  EXPECT_EQ(ascii.positions[3], (Vec3{0, 0, -1.5f}));
  for (const bool big_endian : {false, true}) {
    const TriangleMesh binary = read_mesh(folder.write("b.ply", ply_tetrahedron(false, big_endian)));
    EXPECT_EQ(binary.positions, ascii.positions);
    EXPECT_EQ(binary.triangles, ascii.triangles);
  }
}

TEST(MeshFiles, TruncatedPlyIsAnError) {
  const TemporaryFolder folder;
  for (const bool ascii : {false, true}) {
    const std::string whole = ply_tetrahedron(ascii, false);
    // The last bytes of the ascii form are a digit and a line end: without the line end it is still whole.
    for (std::size_t size = 0; size + 2 < whole.size(); size += 3)
      EXPECT_NE(error_of(folder.write("cut.ply", whole.substr(0, size))), "no error") << ascii << " " << size;
  }
}

/// A triangle and its buffer: three float positions, three 16-bit indices.
struct Gltf {
  std::string buffer;
  std::string json;
};

Gltf gltf_triangle(const std::string& node, int count = 3, std::uint16_t last_index = 2) {
  Gltf gltf;
  for (const float x : {0.f, 0.f, 0.f, 1.f, 0.f, 0.f, 0.f, 1.f, 0.f}) append(gltf.buffer, x);
  for (const std::uint16_t index : {std::uint16_t{0}, std::uint16_t{1}, last_index}) append(gltf.buffer, index);
  gltf.json = R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[)" + node +
              R"(],"meshes":[{"primitives":[{"attributes":{"POSITION":0},"indices":1}]}],"accessors":[)" +
              R"({"bufferView":0,"componentType":5126,"type":"VEC3","min":[0,0,0],"max":[1,1,0],"count":)" +
              std::to_string(count) + R"(},{"bufferView":1,"componentType":5123,"type":"SCALAR","count":3}],)" +
              R"("bufferViews":[{"buffer":0,"byteLength":36},{"buffer":0,"byteOffset":36,"byteLength":6}],)" +
              R"("buffers":[{"byteLength":42,"uri":"triangle.bin"}]})";
  return gltf;
}

std::string to_glb(const Gltf& gltf) {
  std::string json = gltf.json, buffer = gltf.buffer;
  json.replace(json.find(R"(,"uri":"triangle.bin")"), std::strlen(R"(,"uri":"triangle.bin")"), "");
  json.resize((json.size() + 3) / 4 * 4, ' ');
  buffer.resize((buffer.size() + 3) / 4 * 4, '\0');
  std::string glb = "glTF";
  append(glb, std::uint32_t{2}), append(glb, static_cast<std::uint32_t>(12 + 8 + json.size() + 8 + buffer.size()));
  append(glb, static_cast<std::uint32_t>(json.size())), glb += "JSON" + json;
  append(glb, static_cast<std::uint32_t>(buffer.size())), glb += std::string("BIN\0", 4) + buffer;
  return glb;
}

TEST(MeshFiles, GltfAndGlbAgree_AndNodesMoveTheirMeshes) {
  const TemporaryFolder folder;
  const Gltf gltf = gltf_triangle(R"({"children":[1],"translation":[10,0,0]},{"mesh":0,"scale":[2,-2,2]})");
  folder.write("triangle.bin", gltf.buffer);
  const TriangleMesh text = read_mesh(folder.write("t.gltf", gltf.json));
  EXPECT_EQ(text.positions, (std::vector<Vec3>{{10, 0, 0}, {12, 0, 0}, {10, -2, 0}}));
  // The scale mirrors, so the winding is turned: the face still looks to +z.
  EXPECT_EQ(text.triangles, (std::vector<Triangle>{{0, 2, 1}}));
  const TriangleMesh binary = read_mesh(folder.write("t.glb", to_glb(gltf)));
  EXPECT_EQ(binary.positions, text.positions);
  EXPECT_EQ(binary.triangles, text.triangles);
}

TEST(MeshFiles, HostileGltfIsRefused) {
  const TemporaryFolder folder;
  const auto error_for = [&](const Gltf& gltf) {
    folder.write("triangle.bin", gltf.buffer);
    return error_of(folder.write("t.gltf", gltf.json));
  };
  EXPECT_EQ(error_for(gltf_triangle(R"({"mesh":0})")), "no error");
  EXPECT_THAT(error_for(gltf_triangle(R"({"mesh":0})", 3, 7)), HasSubstr("below 3, found 7"));
  EXPECT_THAT(error_for(gltf_triangle(R"({"mesh":0})", 2000000000)), HasSubstr("expected"));
  EXPECT_THAT(error_for(gltf_triangle(R"({"mesh":5})")), HasSubstr("expected"));
  EXPECT_THAT(error_for(gltf_triangle(R"({"children":[0],"mesh":0})")), HasSubstr("cycle"));
  std::filesystem::remove(folder / "triangle.bin");
  EXPECT_NE(error_of(folder / "t.gltf"), "no error");
  const std::string glb = to_glb(gltf_triangle(R"({"mesh":0})"));
  for (std::size_t size = 0; size < glb.size() - 4; size += 7)
    EXPECT_NE(error_of(folder.write("cut.glb", glb.substr(0, size))), "no error") << size;
}

/// A triangle whose second vertex is replaced by (5, 6, 7), with a skin and a morph that are not applied. `index`: of
/// the vertex, as the file says it; `base`: of the buffer view with the others, or none.
Gltf sparse_triangle(int index, bool has_base) {
  Gltf gltf;
  for (const float value : {0.0f, 0.0f, 0.0f, 1.0f, 0.0f, 0.0f, 0.0f, 1.0f, 0.0f}) append(gltf.buffer, value);
  append(gltf.buffer, static_cast<std::uint16_t>(index)), append(gltf.buffer, std::uint16_t{0});
  for (const float value : {5.0f, 6.0f, 7.0f}) append(gltf.buffer, value);
  gltf.json = std::string(R"({"asset":{"version":"2.0"},"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0,"skin":0}],)") +
              R"("skins":[{"joints":[0]}],"meshes":[{"primitives":[{"attributes":{"POSITION":0},)" +
              R"("targets":[{"POSITION":0}]}]}],"buffers":[{"uri":"triangle.bin","byteLength":52}],)" +
              R"("bufferViews":[{"buffer":0,"byteLength":36},{"buffer":0,"byteOffset":36,"byteLength":4},)" +
              R"({"buffer":0,"byteOffset":40,"byteLength":12}],"accessors":[{)" +
              (has_base ? R"("bufferView":0,)" : "") +
              R"("componentType":5126,"count":3,"type":"VEC3","sparse":{"count":1,)" +
              R"("indices":{"bufferView":1,"componentType":5123},"values":{"bufferView":2}}}]})";
  return gltf;
}

TEST(MeshFiles, SparseGltfAccessorsReplaceSomeValues_AndSkinsAndMorphsAreNamed) {
  const TemporaryFolder folder;
  const auto read = [&](const Gltf& gltf, MeshReport* report) {
    folder.write("triangle.bin", gltf.buffer);
    return read_mesh(folder.write("t.gltf", gltf.json), report);
  };
  MeshReport report;
  EXPECT_EQ(read(sparse_triangle(1, true), &report).positions, (std::vector<Vec3>{{0, 0, 0}, {5, 6, 7}, {0, 1, 0}}));
  ASSERT_EQ(report.not_applied.size(), 2u);
  EXPECT_THAT(report.not_applied[0], HasSubstr("t.gltf: the skins of 1 nodes are not applied"));
  EXPECT_THAT(report.not_applied[1], HasSubstr("morphs"));
  EXPECT_THAT(error_of(folder.write("t.gltf", sparse_triangle(1, false).json)), HasSubstr("zero-area"));
  folder.write("triangle.bin", sparse_triangle(3, true).buffer);
  EXPECT_THAT(error_of(folder.write("t.gltf", sparse_triangle(3, true).json)), HasSubstr("indices below 3, found 3"));
  folder.write("triangle.bin", std::string(45, 'x'));
  EXPECT_NE(error_of(folder / "t.gltf"), "no error");
}

TEST(MeshFiles, HostileObjIsRefused_WithItsLine) {
  const TemporaryFolder folder;
  const auto error_for = [&](const std::string& rest) {
    return error_of(folder.write("bad.obj", kTriangleObj + rest));
  };
  EXPECT_EQ(error_for("f 1 2 3\n"), "no error");
  EXPECT_THAT(error_for("f 1 2 4\n"), HasSubstr("bad.obj:4: expected a vertex index from 1 to 3, found \"4\""));
  EXPECT_THAT(error_for("f 1 2 0\n"), HasSubstr("bad.obj:4:"));
  EXPECT_THAT(error_for("f 1 2 -4\n"), HasSubstr("bad.obj:4:"));
  EXPECT_THAT(error_for("f 1 2 99999999999999999999\n"), HasSubstr("bad.obj:4:"));
  EXPECT_THAT(error_for("f 1/1 2/1 3/1\n"), HasSubstr("uv index"));
  EXPECT_THAT(error_for("f 1 2\n"), HasSubstr("3 corners"));
  EXPECT_THAT(error_for("f 1 2 x\n"), HasSubstr("found \"x\""));
  EXPECT_THAT(error_for("v nan 0 0\nf 1 2 4\n"), HasSubstr("finite numbers, found \"nan\""));
  EXPECT_THAT(error_for("v 1e999 0 0\nf 1 2 4\n"), HasSubstr("finite"));
  EXPECT_THAT(error_for("v 1e30 0 0\nf 1 2 4\n"), HasSubstr("vertex 3"));
  EXPECT_THAT(error_for("v 1 2\nf 1 2 3\n"), HasSubstr("bad.obj:4:"));
  EXPECT_THAT(error_for(""), HasSubstr("no faces"));
}

TEST(MeshFiles, HostilePlyIsRefused) {
  const TemporaryFolder folder;
  const auto error_for = [&](std::string text, const std::string& from, const std::string& to) {
    text.replace(text.find(from), from.size(), to);
    return error_of(folder.write("bad.ply", text));
  };
  const std::string good = ply_tetrahedron(true, false);
  EXPECT_THAT(error_for(good, "vertex 4", "vertex 4000000000000"), HasSubstr("records"));
  EXPECT_THAT(error_for(good, "3 2 3 0", "3 2 3 4"), HasSubstr("below 4, found 4"));
  EXPECT_THAT(error_for(good, "3 2 3 0", "3 2 3 -1"), HasSubstr("vertex index"));
  EXPECT_THAT(error_for(good, "3 2 3 0", "900000000 2 3 0"), HasSubstr("list"));
  EXPECT_THAT(error_for(good, "-1.5", "nan"), HasSubstr("vertex 3: expected finite"));
  EXPECT_THAT(error_for(good, "float z", "float w"), HasSubstr("x, y and z"));
  EXPECT_THAT(error_for(good, "double x", "quad x"), HasSubstr("scalar"));
  EXPECT_THAT(error_for(good, "ascii", "morse"), HasSubstr("morse"));
}

TEST(MeshFiles, MissingEmptyAndUnknownFilesAreRefused) {
  const TemporaryFolder folder;
  EXPECT_THAT(error_of(folder / "nowhere.obj"), HasSubstr("no such file"));
  EXPECT_THAT(error_of(folder.write("empty.ply", "")), HasSubstr("empty"));
  EXPECT_THAT(error_of(folder.write("mesh.fbx", "solid")), HasSubstr(".fbx"));
  std::filesystem::create_directory(folder / "folder.obj");
  EXPECT_THAT(error_of(folder / "folder.obj"), HasSubstr("something else"));
  EXPECT_THROW(write_mesh(folder / "nowhere" / "mesh.obj", square(1)), Error);
  EXPECT_THROW(write_mesh(folder / "mesh.stl", square(1)), Error);
}

TEST(MeshFiles, NormalsOfASpherePointOutwards) {
  TriangleMesh mesh = icosphere(3);
  compute_normals(mesh);
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) EXPECT_GT(dot(mesh.normals[i], mesh.positions[i]), 0.999f);
}

}  // namespace
}  // namespace redmap
