// Objects from mesh files: parts, tiles, rest positions, units, and uv that are judged.
#include <gtest/gtest.h>

#include "scene/fingerprint.h"
#include "scene/scene_file.h"
#include "scene/scene_test_support.h"
#include "surface/mesh.h"

namespace redmap {
namespace {

/// Two squares side by side, groups "left" and "right", with uv on tiles 1001 and 1012, or both on 1001 and mirrored.
std::string two_squares(bool mirrored) {
  return std::string("v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 2 0 0\nv 2 1 0\n") +
         "vt 0.1 0.1\nvt 0.9 0.1\nvt 0.9 0.9\nvt 0.1 0.9\n" +
         (mirrored ? "vt 0.9 0.1\nvt 0.1 0.1\nvt 0.1 0.9\nvt 0.9 0.9\n"
                   : "vt 1.1 1.1\nvt 1.9 1.1\nvt 1.9 1.9\nvt 1.1 1.9\n") +
         "g left\nf 1/1 2/2 3/3 4/4\ng right\nf 2/5 5/6 6/7 3/8\n";
}

class MeshObjects : public testing::Test {
 protected:
  /// A scene of one object "wall" with this mesh and these keys.
  SceneFile load(const std::string& obj, const std::string& keys, const std::string& rest = "") {
    write(folder_, "wall.obj", obj);
    return SceneFile::load(
        write(folder_, "a.toml",
              "[camera]\nposition=[0,0,5]\n[object.wall]\nmesh='wall.obj'\nshader='noise'\n" + keys + "\n" + rest));
  }
  std::string error_of(const std::string& obj, const std::string& keys) {
    return error_message([&] { load(obj, keys); });
  }
  TemporaryFolder folder_;
};

TEST_F(MeshObjects, EveryTileIsAnObjectWithAMapOfItsOwn) {
  const SceneFile file = load(two_squares(false), "");
  EXPECT_TRUE(file.remarks().empty());
  const std::vector<Object> tiles = file.objects("wall");
  ASSERT_EQ(tiles.size(), 2u);
  EXPECT_EQ(tiles[0].name, "wall.1001");
  EXPECT_EQ(tiles[1].name, "wall.1012");
  EXPECT_EQ(tiles[1].map_path, folder_ / "maps/wall.1012.exr");
  EXPECT_EQ(tiles[0].surface->upper(), (Vec3{1, 1, 0}));
  EXPECT_EQ(tiles[1].surface->lower(), (Vec3{1, 0, 0}));
  EXPECT_NEAR(tiles[1].surface->uv_area(), 0.64, 1e-5);
  EXPECT_EQ(file.objects("wall.1012").size(), 1u);
}

TEST_F(MeshObjects, PartsMayHaveMoreTexels_WithNewUvOnly) {
  const std::string obj = two_squares(false);
  const SceneFile file = load(obj, "part_density = { left = 3 }");
  ASSERT_EQ(file.objects("wall").size(), 1u);
  const TriangleMesh& mesh = *file.objects("wall")[0].surface->mesh();
  const auto area = [&](std::size_t t) {
    const auto [a, b, c] = mesh.uv_triangles[t];
    return cross(mesh.uv[b] - mesh.uv[a], mesh.uv[c] - mesh.uv[a]);
  };
  EXPECT_NEAR(area(0) / area(2), 9, 0.1);
  EXPECT_TRUE(mentions(error_of(obj, "part_density = { left = 3 }\nuv = 'file'"), "made anew"));
  EXPECT_TRUE(mentions(error_of(obj, "part_density = { middle = 3 }"), "middle"));
  EXPECT_TRUE(mentions(error_of(obj, "part_density = { left = 0 }"), "above 0"));
}

TEST_F(MeshObjects, TilesMoveTogether) {
  const SceneFile file = load(two_squares(false), "map = 'other.name.exr'",
                              "[animation]\nframes=11\nturntable={object='wall', degrees_per_frame=2}\n"
                              "[[animation.key]]\ntarget='object.wall.translate'\nframe=1\nvalue=[0,0,0]\n"
                              "[[animation.key]]\ntarget='object.wall.translate'\nframe=11\nvalue=[10,0,0]\n");
  const Scene scene = file.at(6);
  for (const Object& object : scene.objects) {
    EXPECT_EQ(object.transform.translate, (Vec3{5, 0, 0}));
    EXPECT_EQ(object.transform.rotate_degrees, (Vec3{0, 10, 0}));
  }
  EXPECT_EQ(scene.objects[0].map_path, folder_ / "other.name.1001.exr");
}

TEST_F(MeshObjects, MirroredUvAreUnwrappedAnew_AndOneLineSaysSo_UnlessInsistedOn) {
  const SceneFile anew = load(two_squares(true), "");
  ASSERT_EQ(anew.remarks().size(), 1u);
  EXPECT_TRUE(mentions(anew.remarks()[0], "object.wall.mesh: wall.obj: uv overlap on "));
  EXPECT_TRUE(mentions(anew.remarks()[0], "mirrored: unwrapped anew"));
  const SceneFile kept = load(two_squares(true), "uv = 'file'");
  ASSERT_EQ(kept.remarks().size(), 1u);
  EXPECT_TRUE(mentions(kept.remarks()[0], "used all the same"));
  EXPECT_NEAR(kept.objects("wall")[0].surface->uv_area(), 1.28, 1e-5);
  const SceneFile forced = load(two_squares(false), "uv = 'unwrap'");
  EXPECT_TRUE(forced.remarks().empty());
  EXPECT_EQ(forced.objects("wall").size(), 1u);
  EXPECT_TRUE(mentions(error_of("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", "uv='file'"), "expected uv on every face"));
}

TEST_F(MeshObjects, PartsCarryTheirOwnShaders) {
  const SceneFile file =
      load(two_squares(true), "part = 'left'", "[object.other]\nmesh='wall.obj'\npart='right'\nshader='checker'\n");
  EXPECT_TRUE(file.remarks().empty()) << "each half's uv alone are fine";
  EXPECT_EQ(file.objects("wall")[0].surface->upper(), (Vec3{1, 1, 0}));
  EXPECT_EQ(file.objects("other")[0].surface->lower(), (Vec3{1, 0, 0}));
  EXPECT_EQ(file.objects("wall")[0].surface->mesh()->positions.size(), 4u) << "the rest is not carried along";
  EXPECT_TRUE(mentions(error_of(two_squares(true), "part = 'rihgt'"), "found \"rihgt\" (did you mean \"right\"?)"));
}

TEST_F(MeshObjects, UnitsAndUpAxis_AreDoneAsSaid_AndSaidWhereNot) {
  const SceneFile silent = load(two_squares(true), "part = 'left'");
  ASSERT_EQ(silent.assumptions().size(), 1u);
  EXPECT_TRUE(mentions(silent.assumptions()[0], "wall.obj says neither up-axis nor unit: y up, numbers as they are"));
  const SceneFile file = load(two_squares(true), "part = 'left'\nup = 'z'\nunit = 'cm'");
  const auto surface = file.objects("wall")[0].surface;
  EXPECT_EQ(surface->lower(), (Vec3{0, 0, -0.01f}));
  EXPECT_EQ(surface->upper(), (Vec3{0.01f, 0, 0}));
  EXPECT_TRUE(mentions(file.assumptions()[0], "z up, turned to y up, in cm, scaled to metres, as asked for"));
  EXPECT_TRUE(mentions(error_of(two_squares(true), "unit = 'cn'"), "object.wall.unit: expected a unit"));
  EXPECT_TRUE(mentions(error_of(two_squares(true), "up = 'x'"), "expected \"y\" or \"z\", found \"x\""));
}

TEST_F(MeshObjects, ADeformedMeshKeepsItsMap_AndChangesThePicture) {
  write(folder_, "rest.obj", two_squares(false));
  const std::string straight = two_squares(false);
  std::string bent = straight;
  bent.replace(bent.find("v 2 0 0"), 7, "v 2 0 1"), bent.replace(bent.find("v 2 1 0"), 7, "v 2 1 1");
  const SceneFile rest = load(straight, ""), posed = load(bent, "rest_mesh = 'rest.obj'");
  ASSERT_EQ(posed.objects("wall").size(), 2u);
  for (std::size_t i = 0; i < 2; ++i)
    EXPECT_EQ(posed.objects("wall")[i].surface->fingerprint(), rest.objects("wall")[i].surface->fingerprint());
  EXPECT_EQ(posed.objects("wall")[1].surface->upper(), (Vec3{2, 1, 1}));
  EXPECT_NE(scene_fingerprint(posed.at(1)), scene_fingerprint(rest.at(1)));
  EXPECT_TRUE(mentions(error_of("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", "rest_mesh='rest.obj'"),
                       "expected 6 vertices as in the mesh at rest"));
  EXPECT_TRUE(mentions(error_of(straight, "rest_mesh='none.obj'"), "object.wall.rest_mesh: expected a mesh file"));
}

TEST_F(MeshObjects, MeshKeysAreForMeshes) {
  const auto path = write(folder_, "b.toml",
                          "[camera]\nposition=[0,0,5]\n[object.ball]\nsurface='sphere'\nshader='noise'\nuv='auto'\n");
  EXPECT_TRUE(mentions(error_message([&] { SceneFile::load(path); }), "object.ball.uv: expected only for a mesh"));
}

}  // namespace
}  // namespace redmap
