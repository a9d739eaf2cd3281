// Cameras and lights from glTF: known answers for a turned node, and what is refused.
#include "scene/gltf_import.h"

#include <gtest/gtest.h>

#include "scene/scene_file.h"
#include "scene/scene_test_support.h"

namespace redmap {
namespace {

// The camera's parent turns a quarter about y: looking along -z becomes looking along -x.
constexpr const char* kLayout = R"({
  "asset": {"version": "2.0"},
  "extensionsUsed": ["KHR_lights_punctual"],
  "extensions": {"KHR_lights_punctual": {"lights": [
    {"type": "point", "color": [1, 0.5, 0.25], "intensity": 100},
    {"type": "directional", "intensity": 2}]}},
  "cameras": [{"type": "perspective", "perspective": {"yfov": 1.5707963, "aspectRatio": 2, "znear": 0.1}}],
  "scene": 0,
  "scenes": [{"nodes": [0, 2]}],
  "nodes": [
    {"rotation": [0, 0.70710678, 0, 0.70710678], "translation": [5, 0, 0], "children": [1, 3]},
    {"name": "eye", "camera": 0, "translation": [0, 1, 0]},
    {"name": "lamp", "translation": [1, 2, 3], "extensions": {"KHR_lights_punctual": {"light": 0}}},
    {"name": "sun", "extensions": {"KHR_lights_punctual": {"light": 1}}}]
})";

void expect_near(Vec3 found, Vec3 expected) { EXPECT_LT(length(found - expected), 1e-5f) << found.x << " " << found.y; }

TEST(GltfImport, CameraAndLights_StandInWorldSpace) {
  const TemporaryFolder folder;
  const GltfImport import = import_gltf(write(folder, "layout.gltf", kLayout));
  ASSERT_TRUE(import.camera.has_value());
  expect_near(import.camera->position, {5, 1, 0});
  expect_near(import.camera->look_at, {4, 1, 0});
  expect_near(import.camera->up, {0, 1, 0});
  EXPECT_NEAR(import.camera->vertical_fov_degrees, 90, 1e-4);
  EXPECT_EQ(import.camera->width, 2 * import.camera->height);
  ASSERT_EQ(import.lights.size(), 2u);
  EXPECT_EQ(import.lights[0].name, "sun");
  expect_near(import.lights[0].to_light, {1, 0, 0});
  EXPECT_EQ(import.lights[0].intensity, (Rgb{2, 2, 2}));
  EXPECT_EQ(import.lights[1].type, Light::Type::kPoint);
  expect_near(import.lights[1].position, {1, 2, 3});
  EXPECT_EQ(import.lights[1].intensity, (Rgb{100, 50, 25}));
}

TEST(GltfImport, TheSceneFile_RedefinesWhatItNames) {
  const TemporaryFolder folder;
  write(folder, "layout.gltf", kLayout);
  const auto path = write(folder, "a.toml",
                          "[import]\ngltf='layout.gltf'\n[camera]\nfov=30\n"
                          "[light.sun]\ntype='directional'\nto_light=[0,1,0]\n");
  const Scene scene = SceneFile::load(path).at(1);
  expect_near(scene.camera.position, {5, 1, 0});
  EXPECT_EQ(scene.camera.vertical_fov_degrees, 30);
  ASSERT_EQ(scene.lights.size(), 2u);
  EXPECT_EQ(scene.lights[0].name, "lamp");
  EXPECT_EQ(scene.lights[1].to_light, (Vec3{0, 1, 0}));
}

TEST(GltfImport, BrokenFiles_AreRefusedAtTheirKey) {
  const TemporaryFolder folder;
  std::string spot = kLayout, wild = kLayout, cycle = kLayout;
  spot.replace(spot.find("\"point\""), 7, "\"spot\", \"spot\": {}");
  wild.replace(wild.find("\"light\": 1"), 10, "\"light\": 7");
  cycle.replace(cycle.find("[1, 3]"), 6, "[0, 3]");
  std::string closed = kLayout, dark = kLayout, distant = kLayout;
  closed.replace(closed.find("1.5707963"), 9, "3.2");
  dark.replace(dark.find("\"intensity\": 2"), 14, "\"intensity\": -2");
  distant.replace(distant.find("[1, 2, 3]"), 9, "[1, 2, 1e300]");
  const std::string truncated = std::string(kLayout).substr(0, 300);
  for (const auto& [text, complaint] : std::vector<std::pair<std::string, const char*>>{
           {spot, "light \"lamp\": expected type point or directional, found spot"},
           {wild, "expected a light index below 2, found 7"},
           {cycle, "found a cycle"},
           {closed, "camera \"eye\": expected yfov above 0 and below pi, found 3.2"},
           {dark, "light \"sun\": expected a finite place and an intensity from 0"},
           {distant, "light \"lamp\": expected a finite place and an intensity from 0"},
           {truncated, "expected sound glTF"},
           {"", "found an empty file"}}) {
    write(folder, "broken.gltf", text);
    const auto path = write(folder, "a.toml", "[import]\ngltf='broken.gltf'\n");
    EXPECT_TRUE(mentions(error_message([&] { SceneFile::load(path); }), "a.toml:2:6: import.gltf: "));
    EXPECT_TRUE(mentions(error_message([&] { SceneFile::load(path); }), complaint));
  }
  const auto path = write(folder, "b.toml", "[import]\ngltf='no.gltf'\n");
  EXPECT_TRUE(
      mentions(error_message([&] { SceneFile::load(path); }), "import.gltf: expected a glTF file, found no file"));
}

}  // namespace
}  // namespace redmap
