// Broken scenes: each is refused in one line that says where, what was expected and what was found.
#include <gtest/gtest.h>

#include "base/random.h"
#include "scene/scene_file.h"
#include "scene/scene_test_support.h"
#include "shader/shader.h"

namespace redmap {
namespace {

constexpr const char* kCamera = "[camera]\nposition=[0,0,5]\n";
constexpr const char* kBall = "[object.ball]\nsurface='sphere'\nshader='noise'\n";

/// A file and a part of the complaint about it.
struct Broken {
  std::string text;
  const char* complaint;
};

void expect_refused(const Broken& broken, const std::vector<std::string>& overrides = {}) {
  const TemporaryFolder folder;
  const auto path = write(folder, "a.toml", broken.text);
  EXPECT_TRUE(mentions(error_message([&] { SceneFile::load(path, overrides); }), broken.complaint)) << broken.text;
}

TEST(BrokenScene, Text) {
  expect_refused({"", "expected a [camera] table, found none"});
  expect_refused({kBall, "expected a [camera] table, found none"});
  expect_refused({"camera = 3", "a.toml:1:10: camera: expected a table, found 3"});
  expect_refused({"[camera", "a.toml:1:8: this is no TOML"});
  expect_refused({"[camera]\nfov=1\nfov=2\n", "this is no TOML"});
  expect_refused({std::string(kCamera) + "\"a\\nb\"=3", "a b: unknown key"});
  expect_refused({"[camera]\nposition=\"a\\nb\"", "found \"a b\""});
  expect_refused({std::string("\xff\xfe\0", 3), "this is no TOML"});
  expect_refused({std::string(kCamera) + "[objects.a]", "objects: unknown key (did you mean \"object\"?)"});
}

TEST(BrokenScene, Files) {
  const TemporaryFolder folder;
  EXPECT_TRUE(mentions(error_message([&] { SceneFile::load(folder / "b.toml"); }), "no such file"));
  EXPECT_TRUE(mentions(error_message([&] { SceneFile::load(folder / ""); }), "found a folder"));
}

TEST(BrokenScene, Camera) {
  for (const Broken& broken : std::vector<Broken>{
           {"[camera]\n", "camera.position: expected three finite numbers [x, y, z], found nothing"},
           {"[camera]\nposition=[0,0]",
            "a.toml:2:10: camera.position: expected three finite numbers [x, y, z], found [0, 0]"},
           {"[camera]\nposition=[0,0,nan]", "expected three finite numbers [x, y, z], found [0, 0, nan]"},
           {"[camera]\nposition=[0,0,1e39]", "expected three finite numbers"},
           {"[camera]\nposition=[0,0,'a']", "found [0, 0, \"a\"]"},
           {std::string(kCamera) + "fov=0",
            "a.toml:3:5: camera.fov: expected an angle in degrees above 0 and below 180, found 0"},
           {std::string(kCamera) + "fov=180", "found 180"},
           {std::string(kCamera) + "fov=nan", "found nan"},
           {std::string(kCamera) + "fov='wide'", "found \"wide\""},
           {std::string(kCamera) + "width=0", "camera.width: expected a whole number from 1 to 16384, found 0"},
           {std::string(kCamera) + "height=2.5", "camera.height: expected a whole number from 1 to 16384, found 2.5"},
           {std::string(kCamera) + "postion=1", "a.toml:3:9: camera.postion: unknown key (did you mean \"position\"?)"},
           {"[camera]\nposition=[0,0,0]", "camera at frame 1: expected look_at away from position"},
           {"[camera]\nposition=[0,5,0]", "camera at frame 1: expected up across the viewing direction"},
           {std::string(kCamera) + "up=[0,0,0]", "expected up across the viewing direction"}})
    expect_refused(broken);
}

TEST(BrokenScene, Lights) {
  for (const Broken& broken : std::vector<Broken>{
           {"[light.a]\ntype='spot'",
            "a.toml:4:6: light.a.type: expected \"point\" or \"directional\", found \"spot\""},
           {"[light.a]\nposition=[1,2,3]", "light.a.type: expected \"point\" or \"directional\", found nothing"},
           {"[light.a]\ntype='point'", "light.a.position: expected three finite numbers [x, y, z], found nothing"},
           {"[light.a]\ntype='point'\nto_light=[1,0,0]", "light.a.to_light: expected only for a directional light"},
           {"[light.a]\ntype='directional'\nposition=[1,0,0]", "light.a.position: expected only for a point light"},
           {"[light.a]\ntype='directional'\nto_light=[0,0,0]", "light.a.to_light at frame 1: expected a direction"},
           {"[light.a]\ntype='point'\nposition=[1,0,0]\nintensity=-1",
            "light.a.intensity: expected [r, g, b] or one number, finite and not below 0, found -1"},
           {"[light.a]\ntype='point'\nposition=[1,0,0]\nintensity=[1,2]", "found [1, 2]"},
           {"[light.a]\ntype='point'\nposition=[1,0,0]\nintensity=inf", "found inf"},
           {"[light.a]\ntype='point'\nposition=[1,0,0]\nshadows=1", "light.a.shadows: expected true or false, found 1"},
           {"[light]\na=3", "light.a: expected a table, found 3"}})
    expect_refused({kCamera + broken.text, broken.complaint});
}

TEST(BrokenScene, Objects) {
  for (const Broken& broken : std::vector<Broken>{
           {"[object.a]\nshader='noise'", "object.a.mesh: expected a mesh or a surface"},
           {"[object.a]\nsurface='sphere'\nmesh='a.obj'\nshader='noise'",
            "expected either a mesh or a surface, found both"},
           {"[object.a]\nsurface='torus'\nshader='noise'",
            "object.a.surface: expected \"sphere\" or \"cylinder\", found \"torus\""},
           {"[object.a]\nsurface='sphere'", "object.a.shader: expected text in quotes, found nothing"},
           {"[object.a]\nsurface='sphere'\nshader='nois'", "a.toml:5:8: object.a.shader: "},
           {"[object.a]\nsurface='sphere'\nshader='nois'", "did you mean 'noise'?"},
           {"[object.a]\nmesh='no.obj'\nshader='noise'",
            "a.toml:4:6: object.a.mesh: expected a mesh file, found no file "},
           {"[object.a]\nmesh='a.toml'\nshader='noise'", "a.toml:4:6: object.a.mesh: "},
           {"[object.a]\nmesh='a.obj'\nradius=1\nshader='noise'",
            "object.a.radius: expected only for a sphere or a cylinder"},
           {"[object.a]\nsurface='sphere'\nheight=1\nshader='noise'", "object.a.height: expected only for a cylinder"},
           {std::string(kBall) + "radius=0", "object.ball.radius: expected a number above 0, found 0"},
           {std::string(kBall) + "scale=-1", "a.toml:6:7: object.ball.scale: expected a number above 0, found -1"},
           {std::string(kBall) + "scale=1e-60", "object.ball.scale: expected a number above 0"},
           {std::string(kBall) + "scale=inf", "object.ball.scale: expected a number above 0, found inf"},
           {std::string(kBall) + "map_size=0",
            "object.ball.map_size: expected a whole number from 1 to 16384, found 0"},
           {std::string(kBall) + "map=''", "object.ball.map: expected text in quotes"},
           {std::string(kBall) + "mapsize=3", "object.ball.mapsize: unknown key (did you mean \"map_size\"?)"},
           {std::string(kBall) + "parameters=3", "object.ball.parameters: expected a table, found 3"},
           {std::string(kBall) + "parameters={colour=3}",
            "a.toml:6:20: object.ball.parameters.colour: expected a parameter of shader noise, found \"colour\""},
           {std::string(kBall) + "rotate=90", "object.ball.rotate: expected three finite numbers [x, y, z], found 90"}})
    expect_refused({kCamera + broken.text, broken.complaint});
}

TEST(BrokenScene, ParameterOfTheWrongKind_NamesItsPlace) {
  const std::string name = library_shader_info("noise").parameters.front().name;
  const std::string scene = std::string(kCamera) + kBall;
  expect_refused(
      {scene + "parameters={" + name + "='a'}", "expected a finite number or an array of them, found \"a\""});
  expect_refused({scene + "parameters={" + name + "=[1,2,3,4]}", "a.toml:6:12: object.ball.parameters: "});
}

TEST(BrokenScene, Animation) {
  const std::string scene = std::string(kCamera) + kBall + "[animation]\nframes=10\n";
  const std::string key = "[[animation.key]]\n";
  for (const Broken& broken : std::vector<Broken>{
           {"fps=0", "animation.fps: expected a number above 0, found 0"},
           {"turntable={object='bal'}",
            "animation.turntable.object: expected an object of the scene, found \"bal\" (did you mean \"ball\"?)"},
           {key + "frame=1\nvalue=1", "animation.key[0].target: expected text in quotes, found nothing"},
           {key + "target='camera.positon'\nframe=1\nvalue=1",
            "a.toml:9:8: animation.key[0].target: expected something that moves"},
           {key + "target='camera.positon'\nframe=1\nvalue=1",
            "found \"camera.positon\" (did you mean \"camera.position\"?)"},
           {key + "target='object.ball.shader'\nframe=1\nvalue=1", "expected something that moves"},
           {key + "target='camera.position'\nframe=0\nvalue=[1,2,3]",
            "animation.key[0].frame: expected a whole number from 1"},
           {key + "target='camera.position'\nframe=1\nvalue=3",
            "animation.key[0].value: expected three finite numbers"},
           {key + "target='camera.fov'\nframe=1\nvalue=190", "animation.key[0].value: expected an angle"},
           {key + "target='object.ball.scale'\nframe=1\nvalue=0", "animation.key[0].value: expected a number above 0"},
           {key + "target='camera.fov'\nframe=1\nvalue=9\n" + key + "target='camera.fov'\nframe=1\nvalue=9",
            "animation.key[1].frame: expected one key of camera.fov a frame, found two at frame 1"},
           {key + "target='camera.position'\nframe=1\nvalue=[0,0,1]\n" + key +
                "target='camera.position'\nframe=9\nvalue=[0,0,-1]",
            "camera at frame 5: expected look_at away from position"}})
    expect_refused({scene + broken.text, broken.complaint});
  expect_refused({std::string(kCamera) + "[animation]\nfps=3",
                  "animation.frames: expected a whole number from 1 to 100000, found nothing"});
}

TEST(BrokenScene, Overrides) {
  const std::string scene = std::string(kCamera) + kBall;
  for (const auto& [text, complaint] : std::vector<std::pair<const char*, const char*>>{
           {"camera.fov", "-D camera.fov: expected object.parameter=value, found no value"},
           {"=3", "-D =3: expected object.parameter=value"},
           {"camera.fov=-3",
            "-D camera.fov=-3: camera.fov: expected an angle in degrees above 0 and below 180, found -3"},
           {"camera.fov=wide", "camera.fov: expected an angle in degrees above 0 and below 180, found \"wide\""},
           {"camera.foo=3", "-D camera.foo=3: camera.foo: unknown key"},
           {"bal.scale=3",
            "-D bal.scale=3: expected an object of the scene, camera or light before the first dot, found \"bal\" (did "
            "you mean \"ball\"?)"},
           {"ball.colour=3", "object.ball.parameters.colour: expected a parameter of shader noise"},
           {"camera..fov=3", "-D camera..fov=3:1:"}})
    expect_refused({scene, complaint}, {text});
}

/// Whatever the bytes, a scene loads or is refused by an Error of one line: nothing else is thrown, nothing crashes.
void expect_scene_or_error(const TemporaryFolder& folder, const std::string& text) {
  const auto path = write(folder, "a.toml", text);
  try {
    SceneFile::load(path);
  } catch (const Error& error) {
    EXPECT_EQ(std::string_view(error.what()).find('\n'), std::string_view::npos) << error.what();
  }
}

TEST(BrokenScene, TruncatedAndScrambledFiles_LoadOrAreRefused) {
  const TemporaryFolder folder;
  const std::string scene = std::string(kCamera) + "[light.a]\ntype='point'\nposition=[1,2,3]\nintensity=5\n" + kBall +
                            "map_size=64\n[animation]\nframes=3\n[[animation.key]]\ntarget='camera.fov'\nframe=2\n"
                            "value=30\n";
  for (std::size_t size = 0; size <= scene.size(); size += 3) expect_scene_or_error(folder, scene.substr(0, size));
  Random random(1);
  for (int round = 0; round < 300; ++round) {
    std::string scrambled = scene;
    for (int k = 0; k < 3; ++k)
      scrambled[random.below(static_cast<std::uint32_t>(scene.size()))] =
          round % 2 ? scene[random.below(static_cast<std::uint32_t>(scene.size()))]
                    : static_cast<char>(random.below(256));
    expect_scene_or_error(folder, scrambled);
  }
}

}  // namespace
}  // namespace redmap
