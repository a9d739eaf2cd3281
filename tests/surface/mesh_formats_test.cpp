// What the formats bring besides vertices and faces: parts, strips, compression, polygons of any shape; and STL.
#include <draco/compression/encode.h>
#include <draco/mesh/triangle_soup_mesh_builder.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstring>

#include "base/error.h"
#include "shapes.h"
#include "surface/triangulate.h"
#include "temporary_folder.h"

namespace redmap {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

std::string error_of(const std::filesystem::path& path) {
  try {
    read_mesh(path);
  } catch (const Error& error) {
    return error.what();
  }
  return "no error";
}

template <typename T>
void append(std::string& bytes, T value) {
  bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

double area_of(const TriangleMesh& mesh) {
  double area = 0;
  for (const auto& [a, b, c] : mesh.triangles)
    area += 0.5 * length(cross(mesh.positions[b] - mesh.positions[a], mesh.positions[c] - mesh.positions[a]));
  return area;
}

std::string stl_bytes(const TriangleMesh& mesh, const std::string& header = "solid in name only") {
  std::string bytes = header;
  bytes.resize(80);
  append(bytes, static_cast<std::uint32_t>(mesh.triangles.size()));
  for (const Triangle& t : mesh.triangles) {
    append(bytes, Vec3{});
    for (const std::uint32_t corner : t) append(bytes, mesh.positions[corner]);
    append(bytes, std::uint16_t{0});
  }
  return bytes;
}

TEST(Stl, BinaryFacetsShareTheirCornersAgain_EvenWhereTheHeaderSaysSolid) {
  const TemporaryFolder folder;
  const TriangleMesh sphere = icosphere(1), read = read_mesh(folder.write("s.STL", stl_bytes(sphere)));
  EXPECT_EQ(read.positions.size(), sphere.positions.size());
  EXPECT_EQ(read.triangles.size(), sphere.triangles.size());
  EXPECT_NEAR(area_of(read), area_of(sphere), 1e-6);
  for (std::size_t t = 0; t < read.triangles.size(); ++t)
    EXPECT_GT(dot(read.normals[read.normal_triangles[t][0]], read.positions[read.triangles[t][0]]), 0.7f);
}

TEST(Stl, AsciiSolidsAreParts) {
  const TemporaryFolder folder;
  const std::string facet =
      "facet normal 0 0 1\n outer loop\n vertex 0 0 0\n vertex +1 0 0\n vertex 0 1e0 0\n endloop\n endfacet\n";
  const auto path = folder.write(
      "two.stl", "solid left half\n" + facet + "endsolid left half\nSOLID right\n" + facet + facet + "endsolid\n");
  const TriangleMesh mesh = read_mesh(path);
  EXPECT_EQ(mesh.positions.size(), 3u);
  EXPECT_THAT(part_names(mesh), ElementsAre("left half", "right"));
  EXPECT_THAT(select_part(mesh, "right"), ElementsAre(0, 1, 1));
}

TEST(Stl, HostileFilesAreRefused) {
  const TemporaryFolder folder;
  const std::string whole = stl_bytes(icosphere(0));
  for (std::size_t size = 1; size < whole.size(); size += 13)
    EXPECT_NE(error_of(folder.write("cut.stl", whole.substr(0, size))), "no error") << size;
  std::string absurd = whole;
  std::memset(absurd.data() + 80, 0xff, 4);
  absurd[0] = 'x';
  EXPECT_THAT(error_of(folder.write("absurd.stl", absurd)), HasSubstr("4294967295 facets"));
  std::string not_finite = whole;
  const float nan = std::nanf("");
  std::memcpy(not_finite.data() + 84 + 12, &nan, 4);
  EXPECT_THAT(error_of(folder.write("nan.stl", not_finite)), HasSubstr("expected finite coordinates"));
  EXPECT_THAT(error_of(folder.write("a.stl", "solid\nfacet normal 0 0 1\nouter loop\nvertex 0 0 x\n")),
              HasSubstr("a.stl:4: expected a number, found \"x\""));
  EXPECT_THAT(error_of(folder.write("b.stl", "solid\nendsolid\n")), HasSubstr("no vertices"));
}

TEST(Obj, GroupsAndMaterialsArePartsAndComeBack) {
  const TemporaryFolder folder;
  const auto path =
      folder.write("parts.obj",
                   "v 0 0 0\nv 1 0 0\nv 0 1 0\no car\nusemtl shiny red\nf 1 2 3\ng wheel \nf 1 2 3\nusemtl rubber\n"
                   "f 1 2 3\ng car\nf 3 2 1\n");
  write_mesh(folder / "again.obj", read_mesh(path));
  for (const auto& file : {path, folder / "again.obj"}) {
    const TriangleMesh mesh = read_mesh(file);
    EXPECT_THAT(part_names(mesh), ElementsAre("car", "wheel", "shiny red", "rubber"));
    EXPECT_THAT(select_part(mesh, "car"), ElementsAre(1, 0, 0, 1));
    EXPECT_THAT(select_part(mesh, "wheel"), ElementsAre(0, 1, 1, 0));
    EXPECT_THAT(select_part(mesh, "rubber"), ElementsAre(0, 0, 1, 1));
    EXPECT_THROW(select_part(mesh, "whel"), Error);
  }
}

TEST(Obj, LongLinesPlusSignsAndByteOrderMarksAreRead_Utf16IsNot) {
  const TemporaryFolder folder;
  const auto path =
      folder.write("odd.obj", "\xEF\xBB\xBFv +0 0 0\nv 1 \\\n 0 0\nv 0 1 0\nf 1 \\\r\n2 \\\n3\nf 1 2 4\n");
  EXPECT_THAT(error_of(path), HasSubstr("odd.obj:8: expected a vertex index"));
  EXPECT_THAT(error_of(folder.write("wide.obj", std::string("\xFE\xFF\0v", 4))), HasSubstr("UTF-16"));
}

TEST(Triangulate, ConcavePolygonsKeepTheirArea) {
  // A comb of twenty teeth, 1 wide and 10 high, on a back 20 long and 1 high: clockwise.
  std::vector<Vec3> comb;
  for (int i = 0; i < 20; ++i) {
    const float x = static_cast<float>(i);
    comb.push_back({x, 0, 0}), comb.push_back({x + 0.5f, 10, 0});
  }
  comb.push_back({20, 0, 0}), comb.push_back({20, -1, 0}), comb.push_back({0, -1, 0});
  std::vector<std::array<int, 3>> triangles;
  triangulate(comb, triangles);
  EXPECT_EQ(triangles.size(), comb.size() - 2);
  double sum = 0;
  for (const auto& [a, b, c] : triangles) {
    const float z = cross(comb[b] - comb[a], comb[c] - comb[a]).z;
    EXPECT_LE(z, 0) << "every triangle turns as the polygon does";
    sum -= 0.5 * z;
  }
  EXPECT_NEAR(sum, 20 * 5 + 20, 1e-4);
}

TEST(Triangulate, ADartIsCutInside_WhicheverCornerComesFirst) {
  const std::vector<Vec3> dart = {{0, 0, 0}, {2, -1, 0}, {0.5f, 0, 0}, {2, 1, 0}};
  for (int first = 0; first < 4; ++first) {
    std::vector<Vec3> turned = dart;
    std::rotate(turned.begin(), turned.begin() + first, turned.end());
    std::vector<std::array<int, 3>> triangles;
    triangulate(turned, triangles);
    for (const auto& [a, b, c] : triangles)
      EXPECT_GT(cross(turned[b] - turned[a], turned[c] - turned[a]).z, 0) << first;
  }
}

/// A file of one primitive: positions of an octahedron's four upper faces, as mode and indices say.
std::string gltf(const std::string& primitive, const std::string& buffer, const std::string& more = "") {
  static constexpr char kDigits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string encoded;
  for (std::size_t i = 0; i < buffer.size(); i += 3) {
    std::uint32_t bits = 0;
    for (std::size_t k = 0; k < 3; ++k)
      bits = bits << 8 | (i + k < buffer.size() ? static_cast<std::uint8_t>(buffer[i + k]) : 0);
    for (int k = 3; k >= 0; --k) encoded += kDigits[bits >> (6 * k) & 63];
  }
  for (std::size_t i = 0; i < (3 - buffer.size() % 3) % 3; ++i) encoded[encoded.size() - 1 - i] = '=';
  return R"({"asset":{"version":"2.0"},"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0,"name":"body"}],"materials":[{"name":"tin"}],)" +
         more + R"("meshes":[{"primitives":[)" + primitive + R"(]}],"buffers":[{"byteLength":)" +
         std::to_string(buffer.size()) + R"(,"uri":"data:application/octet-stream;base64,)" + encoded + R"("}]})";
}

TEST(Gltf, StripsAndFansAreUnrolled_PointsAndLinesPassedOver) {
  const TemporaryFolder folder;
  std::string buffer;
  for (const Vec3 p : {Vec3{0, 0, 0}, Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{1, 1, 0}}) append(buffer, p);
  const auto primitive = [&](int mode) {
    return R"({"attributes":{"POSITION":0,"COLOR_0":0},"material":0,"mode":)" + std::to_string(mode) + "}";
  };
  const std::string accessors =
      R"("accessors":[{"bufferView":0,"componentType":5126,"type":"VEC3","count":4}],"bufferViews":[{"buffer":0,"byteLength":48}],)";
  const TriangleMesh strip =
      read_mesh(folder.write("s.gltf", gltf(primitive(0) + "," + primitive(5), buffer, accessors)));
  EXPECT_THAT(strip.triangles, ElementsAre(Triangle{0, 1, 2}, Triangle{2, 1, 3}));
  EXPECT_THAT(part_names(strip), ElementsAre("body", "tin"));
  const TriangleMesh fan = read_mesh(folder.write("f.gltf", gltf(primitive(6), buffer, accessors)));
  EXPECT_THAT(fan.triangles, ElementsAre(Triangle{0, 1, 2}, Triangle{0, 2, 3}));
  EXPECT_THAT(error_of(folder.write("l.gltf", gltf(primitive(1), buffer, accessors))), HasSubstr("found none"));
  std::string old = gltf(primitive(6), buffer, accessors);
  old.replace(old.find("2.0"), 3, "1.0");
  EXPECT_THAT(error_of(folder.write("old.gltf", old)), HasSubstr("expected glTF 2.0, found version 1.0"));
}

/// `mesh` by Draco's own encoder, which quantises nothing here: attribute 0 the positions, 1 the uv.
std::string draco_bytes(const TriangleMesh& mesh) {
  draco::TriangleSoupMeshBuilder builder;
  builder.Start(static_cast<int>(mesh.triangles.size()));
  const int position = builder.AddAttribute(draco::GeometryAttribute::POSITION, 3, draco::DT_FLOAT32);
  const int uv = builder.AddAttribute(draco::GeometryAttribute::TEX_COORD, 2, draco::DT_FLOAT32);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto& [a, b, c] = mesh.triangles[t];
    const draco::FaceIndex face(static_cast<std::uint32_t>(t));
    builder.SetAttributeValuesForFace(position, face, &mesh.positions[a], &mesh.positions[b], &mesh.positions[c]);
    builder.SetAttributeValuesForFace(uv, face, &mesh.uv[a], &mesh.uv[b], &mesh.uv[c]);
  }
  draco::EncoderBuffer buffer;
  draco::Encoder encoder;
  EXPECT_TRUE(encoder.EncodeMeshToBuffer(*builder.Finalize(), &buffer).ok());
  return {buffer.data(), buffer.size()};
}

TEST(Gltf, DracoUnpacksToWhatWasPacked) {
  const TemporaryFolder folder;
  const TriangleMesh mesh = square(4);
  const std::string packed = draco_bytes(mesh);
  const std::string primitive =
      R"({"attributes":{"POSITION":1,"TEXCOORD_0":2},"indices":0,"extensions":{"KHR_draco_mesh_compression":)"
      R"({"bufferView":0,"attributes":{"POSITION":0,"TEXCOORD_0":1}}}})";
  const auto file = [&](const std::string& bytes) {
    return gltf(
        primitive, bytes,
        R"("extensionsRequired":["KHR_draco_mesh_compression"],"bufferViews":[{"buffer":0,"byteLength":)" +
            std::to_string(bytes.size()) +
            R"(}],"accessors":[{"componentType":5125,"type":"SCALAR","count":96},)"
            R"({"componentType":5126,"type":"VEC3","count":25},{"componentType":5126,"type":"VEC2","count":25}],)");
  };
  const TriangleMesh read = read_mesh(folder.write("d.gltf", file(packed)));
  EXPECT_EQ(read.triangles.size(), mesh.triangles.size());
  EXPECT_NEAR(area_of(read), 1, 1e-6);
  for (std::size_t t = 0; t < read.triangles.size(); ++t)
    for (int k = 0; k < 3; ++k) {
      const Vec3 p = read.positions[read.triangles[t][k]];
      const Vec2 uv = read.uv[read.uv_triangles[t][k]];
      EXPECT_EQ(uv, (Vec2{p.x, 1 - p.y})) << "the square's uv are its places, and glTF counts v downwards";
    }
  for (std::size_t size = 1; size < packed.size(); size += 5)
    EXPECT_NE(error_of(folder.write("cut.gltf", file(packed.substr(0, size)))), "no error") << size;
  std::string other = file(packed);
  other.replace(other.find("KHR_draco"), 9, "EXT_spam_");
  EXPECT_THAT(error_of(folder.write("x.gltf", other)), HasSubstr("requires EXT_spam_"));
}

}  // namespace
}  // namespace redmap
