// Scene files: what is written is what is read, for every frame.
#include "scene/scene_file.h"

#include <gtest/gtest.h>

#include "scene/fingerprint.h"
#include "scene/scene_test_support.h"
#include "shader/shader.h"
#include "surface/mesh.h"

namespace redmap {
namespace {

constexpr const char* kScene = R"(
background = [0.1, 0.2, 0.3]
[camera]
position = [0, 1, 9]
look_at = [0, 0.5, 0]
up = [0, 0, -1]
fov = 25
width = 320
height = 200
[light.key]
type = "point"
position = [4, 5, 6]
intensity = [70, 60, 50]
[light.sun]
type = "directional"
to_light = [0, 2, 0]
intensity = 2
shadows = false
[object.ball]
surface = "sphere"
radius = 1.5
shader = "noise"
translate = [1, 2, 3]
rotate = [10, 20, 30]
scale = 0.5
map_size = 256
[object.can]
surface = "cylinder"
shader = "checker"
map = "elsewhere/can.exr"
[animation]
frames = 100
fps = 25
turntable = { object = "can", degrees_per_frame = 3 }
[[animation.key]]
target = "camera.position"
frame = 51
value = [0, 1, 109]
[[animation.key]]
target = "camera.position"
frame = 1
value = [0, 1, 9]
[[animation.key]]
target = "light.sun.to_light"
frame = 1
value = [0, 1, 0]
[[animation.key]]
target = "object.ball.scale"
frame = 1
value = 1
[[animation.key]]
target = "object.ball.scale"
frame = 11
value = 2
)";

constexpr const char* kTetrahedron = R"(v 0 0 0
v 1 0 0
v 0 1 0
v 0 0 1
f 1 3 2
f 1 2 4
f 2 3 4
f 3 1 4
)";

TEST(SceneFile, EverythingWritten_IsRead) {
  const TemporaryFolder folder;
  const SceneFile file = SceneFile::load(write(folder, "a.toml", kScene));
  const Scene scene = file.at(1);
  EXPECT_EQ(scene.background, (Rgb{0.1f, 0.2f, 0.3f}));
  EXPECT_EQ(scene.camera.position, (Vec3{0, 1, 9}));
  EXPECT_EQ(scene.camera.look_at, (Vec3{0, 0.5f, 0}));
  EXPECT_EQ(scene.camera.up, (Vec3{0, 0, -1}));
  EXPECT_EQ(scene.camera.vertical_fov_degrees, 25);
  EXPECT_EQ(scene.camera.width, 320);
  EXPECT_EQ(scene.camera.height, 200);
  ASSERT_EQ(scene.lights.size(), 2u);
  EXPECT_EQ(scene.lights[0].type, Light::Type::kPoint);
  EXPECT_EQ(scene.lights[0].position, (Vec3{4, 5, 6}));
  EXPECT_EQ(scene.lights[0].intensity, (Rgb{70, 60, 50}));
  EXPECT_TRUE(scene.lights[0].shadows);
  EXPECT_EQ(scene.lights[1].type, Light::Type::kDirectional);
  EXPECT_EQ(scene.lights[1].to_light, (Vec3{0, 1, 0}));
  EXPECT_EQ(scene.lights[1].intensity, (Rgb{2, 2, 2}));
  EXPECT_FALSE(scene.lights[1].shadows);
}

TEST(SceneFile, Objects_HaveSurfaceShaderMapAndPlace) {
  const TemporaryFolder folder;
  const SceneFile file = SceneFile::load(write(folder, "a.toml", kScene));
  const Object ball = file.objects("ball").front();
  EXPECT_EQ(ball.surface->fingerprint(), make_sphere(1.5f)->fingerprint());
  EXPECT_EQ(ball.shader->info().name, "noise");
  EXPECT_EQ(ball.map_path, folder / "maps/ball.exr");
  EXPECT_EQ(ball.map_size, 256);
  EXPECT_EQ(ball.transform.translate, (Vec3{1, 2, 3}));
  EXPECT_EQ(ball.transform.rotate_degrees, (Vec3{10, 20, 30}));
  EXPECT_EQ(ball.transform.scale, 0.5f);
  const Object can = file.objects("can").front();
  EXPECT_EQ(can.surface->fingerprint(), make_cylinder(1, 2)->fingerprint());
  EXPECT_EQ(can.map_path, folder / "elsewhere/can.exr");
  EXPECT_EQ(can.map_size, 1024);
  EXPECT_TRUE(mentions(error_message([&] { file.objects("bal"); }), "did you mean \"ball\""));
}

TEST(SceneFile, Frames_FollowKeysInAnyOrder_AndTheTurntable) {
  const TemporaryFolder folder;
  const SceneFile file = SceneFile::load(write(folder, "a.toml", kScene));
  EXPECT_EQ(file.frame_count(), 100);
  EXPECT_EQ(file.frames_per_second(), 25);
  EXPECT_EQ(file.at(26).camera.position, (Vec3{0, 1, 59}));
  EXPECT_EQ(file.at(100).camera.position, (Vec3{0, 1, 109}));
  EXPECT_EQ(file.at(6).objects[0].transform.scale, 1.5f);
  EXPECT_EQ(file.at(11).objects[1].transform.rotate_degrees, (Vec3{0, 30, 0}));
  EXPECT_FLOAT_EQ(file.at(26).time_seconds, 1);
  for (int frame : {0, 101}) EXPECT_TRUE(mentions(error_message([&] { file.at(frame); }), "a frame from 1 to 100"));
}

TEST(SceneFile, TheOrderOfTablesAndKeys_DoesNotMatter) {
  const TemporaryFolder folder;
  const auto a = write(folder, "a.toml",
                       "[object.b]\nsurface='sphere'\nshader='noise'\n[object.a]\nshader='noise'\n"
                       "surface='cylinder'\n[camera]\nfov=30\nposition=[0,0,5]\n");
  const auto b = write(folder, "b.toml",
                       "camera={position=[0,0,5],fov=30.0}\nobject.a={surface='cylinder',"
                       "shader='noise'}\nobject.b.shader='noise'\nobject.b.surface='sphere'\n");
  EXPECT_EQ(scene_fingerprint(SceneFile::load(a).at(1)), scene_fingerprint(SceneFile::load(b).at(1)));
}

TEST(SceneFile, ObjectsOfOneMesh_ShareItsSurface) {
  const TemporaryFolder folder;
  write(folder, "t.obj", kTetrahedron);
  const auto path = write(folder, "a.toml",
                          "[camera]\nposition=[0,0,5]\n[object.a]\nmesh='t.obj'\nshader='noise'\n"
                          "[object.b]\nmesh='./t.obj'\nshader='checker'\n");
  const Scene scene = SceneFile::load(path).at(1);
  EXPECT_NE(scene.objects[0].surface->mesh(), nullptr);
  EXPECT_EQ(scene.objects[0].surface, scene.objects[1].surface);
}

TEST(SceneFile, Overrides_AreAsIfWrittenInTheFile) {
  const TemporaryFolder folder;
  const auto path = write(folder, "a.toml", kScene);
  const std::string parameter = library_shader_info("noise").parameters.front().name;
  const float value = library_shader_info("noise").parameters.front().maximum;
  const std::vector<std::string> overrides{"camera.fov=50",
                                           "camera.fov = 60.0",
                                           "light.key.position=[9, 9, 9]",
                                           "object.can.shader=noise",
                                           "background=0.25",
                                           "animation.frames=7",
                                           fmt::format("ball.{}={}", parameter, value)};
  const SceneFile file = SceneFile::load(path, overrides);
  const Scene scene = file.at(7);
  EXPECT_EQ(file.frame_count(), 7);
  EXPECT_EQ(scene.camera.vertical_fov_degrees, 60);
  EXPECT_EQ(scene.camera.width, 320);
  EXPECT_EQ(scene.lights[0].position, (Vec3{9, 9, 9}));
  EXPECT_EQ(scene.background, (Rgb{0.25f, 0.25f, 0.25f}));
  EXPECT_EQ(file.objects("can").front().shader->info().name, "noise");
  EXPECT_FLOAT_EQ(file.objects("ball").front().shader->parameters().front().front(), value);
}

}  // namespace
}  // namespace redmap
