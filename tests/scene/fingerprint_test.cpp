// The fingerprint changes when, and only when, something that can be seen changes.
#include "scene/fingerprint.h"

#include <gtest/gtest.h>

#include <functional>
#include <set>

namespace redmap {
namespace {

Scene two_spheres() {
  Scene scene;
  scene.lights.push_back({.name = "key", .position = {1, 2, 3}, .to_light = {}});
  scene.lights.push_back({.type = Light::Type::kDirectional, .name = "sun", .position = {}, .to_light = {0, 1, 0}});
  for (const char* name : {"left", "right"}) {
    Object object;
    object.name = name;
    object.surface = make_sphere(1);
    object.shader = make_library_shader("noise");
    scene.objects.push_back(object);
  }
  return scene;
}

using Change = std::function<void(Scene&)>;

TEST(SceneFingerprint, EveryVisibleChange_GivesANewOne) {
  const std::vector<Change> changes{
      [](Scene&) {},
      [](Scene& s) { s.camera.position.x = 1; },
      [](Scene& s) { s.camera.look_at.x = 1; },
      [](Scene& s) { s.camera.up.x = 1; },
      [](Scene& s) { s.camera.vertical_fov_degrees = 41; },
      [](Scene& s) { s.camera.width = 641; },
      [](Scene& s) { s.camera.height = 481; },
      [](Scene& s) { s.background.g = 0.5f; },
      [](Scene& s) { s.lights[0].position.y = 5; },
      [](Scene& s) { s.lights[0].intensity.b = 5; },
      [](Scene& s) { s.lights[0].shadows = false; },
      [](Scene& s) {
        s.lights[1].to_light = {1, 0, 0};
      },
      [](Scene& s) { s.lights[1].intensity.b = 5; },
      [](Scene& s) { s.lights.pop_back(); },
      [](Scene& s) { s.objects.pop_back(); },
      [](Scene& s) { s.objects[0].surface = make_sphere(2); },
      [](Scene& s) { s.objects[0].surface = make_cylinder(1, 1); },
      [](Scene& s) { s.objects[0].shader = make_library_shader("checker"); },
      [](Scene& s) {
        const ParameterInfo& first = library_shader_info("noise").parameters.front();
        std::vector<float> value = first.default_value;
        value[0] = value[0] * 0.75f + 0.125f * (first.minimum + first.maximum);
        s.objects[0].shader = make_library_shader("noise", {{first.name, value}});
      },
      [](Scene& s) { s.objects[0].transform.translate.z = 1; },
      [](Scene& s) { s.objects[1].transform.translate.z = 1; },
      [](Scene& s) { s.objects[0].transform.rotate_degrees.z = 1; },
      [](Scene& s) { s.objects[0].transform.scale = 2; },
  };
  std::set<std::uint64_t> fingerprints;
  for (std::size_t i = 0; i < changes.size(); ++i) {
    Scene scene = two_spheres();
    changes[i](scene);
    EXPECT_TRUE(fingerprints.insert(scene_fingerprint(scene)).second) << "change " << i;
  }
}

TEST(SceneFingerprint, WhatCannotBeSeen_DoesNotCount) {
  const std::vector<Change> changes{
      [](Scene& s) { s.objects[0].name = "other"; },
      [](Scene& s) { s.objects[0].map_path = "other.exr"; },
      [](Scene& s) { s.objects[0].map_size = 7; },
      [](Scene& s) { s.lights[0].name = "other"; },
      [](Scene& s) {
        s.lights[0].to_light = {1, 0, 0};
      },
      [](Scene& s) {
        s.lights[1].position = {1, 0, 0};
      },
      [](Scene& s) { s.time_seconds = 3; },
      [](Scene& s) { s.camera.look_at.x = -0.0f; },
      [](Scene& s) { s.objects[0].surface = make_sphere(1); },
  };
  const std::uint64_t expected = scene_fingerprint(two_spheres());
  for (std::size_t i = 0; i < changes.size(); ++i) {
    Scene scene = two_spheres();
    changes[i](scene);
    EXPECT_EQ(scene_fingerprint(scene), expected) << "change " << i;
  }
}

}  // namespace
}  // namespace redmap
