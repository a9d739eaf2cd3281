// Deformed meshes: hit where they stand, shaded and baked where they were at rest.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/error.h"
#include "shapes.h"
#include "temporary_folder.h"

namespace redmap {
namespace {

using testing::HasSubstr;

/// The square, rolled to a quarter of a cylinder.
TriangleMesh rolled_square(std::uint32_t n) {
  TriangleMesh mesh = square(n);
  for (Vec3& p : mesh.positions) p = {std::sin(p.x), p.y, std::cos(p.x)};
  return mesh;
}

TEST(PosedMesh, IsHitPosed_ShadedAtRest) {
  const auto posed = make_posed_surface(PosedMesh{square(4), rolled_square(4)});
  const auto rest = make_mesh_surface(square(4)), rolled = make_mesh_surface(rolled_square(4));
  for (std::uint32_t t = 0; t < 32; ++t) {
    const HitCoordinates where[] = {{t, {0.3f, 0.5f}}};
    SurfaceHit at, at_rest, at_rolled;
    posed->complete(where, {&at, 1}), rest->complete(where, {&at_rest, 1}), rolled->complete(where, {&at_rolled, 1});
    EXPECT_EQ(at.position, at_rolled.position);
    EXPECT_EQ(at.normal, at_rolled.normal);
    EXPECT_EQ(at.dp_du, at_rolled.dp_du);
    EXPECT_EQ(at.rest.position, at_rest.position);
    EXPECT_EQ(at.rest.normal, at_rest.normal);
    EXPECT_EQ(at.rest.tangent, at_rest.tangent);
    EXPECT_EQ(at_rolled.rest.position, at_rolled.position) << "without a pose, rest is where it stands";
  }
}

TEST(PosedMesh, MapsBelongToItsRest_PicturesToItsPose) {
  const auto posed = make_posed_surface(PosedMesh{square(4), rolled_square(4)});
  const auto rest = make_mesh_surface(square(4));
  EXPECT_EQ(posed->fingerprint(), rest->fingerprint());
  EXPECT_NE(posed->pose_fingerprint(), rest->pose_fingerprint());
  const Vec2 centre[] = {{0.5f, 0.5f}};
  TexelPoints ours, theirs;
  posed->rasterize({16, 16}, {0, 0, 16, 16}, centre, {}, ours);
  rest->rasterize({16, 16}, {0, 0, 16, 16}, centre, {}, theirs);
  ASSERT_EQ(ours.texel.size(), 256u);
  for (std::size_t i = 0; i < ours.texel.size(); ++i)
    EXPECT_EQ(ours.points.position.get(i), theirs.points.position.get(i));
  EXPECT_EQ(posed->mesh()->positions, rolled_square(4).positions) << "what rays hit";
}

TEST(PosedMesh, PolygonsAreCutAsAtRest_WhereverThePoseWouldCutThem) {
  const TemporaryFolder folder;
  const char* const face = "f 1 2 3 4\n";
  const auto rest = folder.write("rest.obj", std::string("v 0 0 0\nv 2 0 0\nv 3 1 0\nv 1 1 0\n") + face);
  const auto posed = folder.write("posed.obj", std::string("v 1 0 0\nv 3 0 0\nv 2 1 0\nv 0 1 0\n") + face);
  EXPECT_NE(read_mesh(rest).triangles, read_mesh(posed).triangles) << "each alone has another shorter diagonal";
  const PosedMesh mesh = read_posed_mesh(rest, posed);
  EXPECT_EQ(mesh.posed.triangles, mesh.rest.triangles);
  EXPECT_EQ(mesh.rest.triangles, read_mesh(rest).triangles);
  EXPECT_EQ(mesh.posed.positions[0], (Vec3{1, 0, 0}));
}

TEST(PosedMesh, CollapsedTrianglesOfThePoseStay_ThoseAtRestGo) {
  const TemporaryFolder folder;
  const char* const faces = "f 1 2 3\nf 1 2 4\n";
  const auto a = folder.write("a.obj", std::string("v 0 0 0\nv 1 0 0\nv 0 1 0\nv 2 0 0\n") + faces);
  const auto b = folder.write("b.obj", std::string("v 0 0 0\nv 1 0 0\nv 2 0 0\nv 0 0 1\n") + faces);
  const PosedMesh mesh = read_posed_mesh(a, b);
  ASSERT_EQ(mesh.rest.triangles.size(), 1u);
  EXPECT_EQ(mesh.posed.triangles.size(), 1u);
  PosedMesh with_uv = mesh;
  with_uv.rest.uv = {{0, 0}, {1, 0}, {0, 1}}, with_uv.rest.uv_triangles = {{0, 1, 2}};
  SurfaceHit at;
  const HitCoordinates where[] = {{0, {0.3f, 0.3f}}};
  make_posed_surface(with_uv)->complete(where, {&at, 1});
  EXPECT_TRUE(std::isfinite(length(at.position) + length(at.normal) + length(at.dp_du) + length(at.rest.normal)));
}

TEST(PosedMesh, OtherTopologiesAreRefused) {
  const TemporaryFolder folder;
  write_mesh(folder / "rest.obj", square(2));
  write_mesh(folder / "finer.obj", square(3));
  TriangleMesh turned = square(2);
  std::swap(turned.triangles[3][0], turned.triangles[3][1]);
  write_mesh(folder / "turned.obj", turned);
  const auto error_of = [&](const char* posed) -> std::string {
    try {
      read_posed_mesh(folder / "rest.obj", folder / posed);
    } catch (const Error& error) {
      return error.what();
    }
    return "no error";
  };
  EXPECT_EQ(error_of("rest.obj"), "no error");
  EXPECT_THAT(error_of("finer.obj"), HasSubstr("expected 9 vertices as in the mesh at rest"));
  EXPECT_THAT(error_of("turned.obj"), HasSubstr("triangle 3 has other vertices"));
}

}  // namespace
}  // namespace redmap
