// Pictures known without rendering them, agreement with the CPU where lights and objects are several, and what a device
// does not take.
#include "gpu/device_renderer.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <fstream>

#include "bake/bake.h"
#include "bake/baselines.h"
#include "base/error.h"
#include "base/temporary_folder.h"
#include "metrics/compare.h"
#include "render/renderer.h"
#include "surface/atlas.h"
#include "surface/shapes.h"
#include "user_shader/user_shader.h"

namespace redmap {
namespace {

[[maybe_unused]] const int kLayerAskedFor = setenv("VK_INSTANCE_LAYERS", "VK_LAYER_KHRONOS_validation", 0);

using Maps = std::vector<ObjectData>;

Object make_ball(const std::shared_ptr<const Shader>& shader, Vec3 translate = {}) {
  Object ball;
  ball.name = "ball";
  ball.surface = make_sphere(1);
  ball.shader = shader;
  ball.transform.translate = translate;
  return ball;
}

/// A ball of radius 1 at the origin seen from +z, without lights.
Scene ball_scene(const std::shared_ptr<const Shader>& shader, int pixels = 48) {
  Scene scene;
  scene.objects.push_back(make_ball(shader));
  scene.camera.width = scene.camera.height = pixels;
  return scene;
}

Light sun(Vec3 to_light, bool shadows) {
  Light light;
  light.type = Light::Type::kDirectional;
  light.to_light = normalized(to_light);
  light.shadows = shadows;
  return light;
}

Light lamp(Vec3 position, float intensity) {
  Light light;
  light.position = position;
  light.intensity = Rgb{1, 1, 1} * intensity;
  return light;
}

Image on_device(const Scene& scene, const DeviceRenderOptions& options, const Maps& maps, int frame = 1) {
  DeviceRenderer renderer(Device::open(), scene, options, maps);
  renderer.render(scene, frame);
  return renderer.picture();
}

DeviceRenderOptions by(Method method, int spp = 0) {
  DeviceRenderOptions options;
  options.method = method, options.spp = spp;
  return options;
}

ObjectData baked(const Object& object, int size) {
  BakeOptions options;
  options.size = size;
  ObjectData data;
  data.map = std::make_shared<const ReductionMap>(bake(*object.surface, *object.shader, options));
  return data;
}

/// What `make` complains of.
template <typename Make>
std::string complaint(const Make& make) {
  try {
    make();
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(DeviceRenderer, WhiteBallUnderASun_IsCosineOverPi) {
  Scene scene = ball_scene(make_library_shader("white"), 65);
  scene.camera.position = {0, 0, 1000};
  scene.camera.vertical_fov_degrees = 0.2f;
  scene.lights = {sun({0, 0, 1}, true)};
  const Image image = on_device(scene, by(Method::kOriginal, 1), {});
  const double brightest = image.rgb(32, 32).r;
  // Pixels across the middle: x = sin, the cosine follows.
  const double pixel = 2 * 1000 * std::tan(0.1 * kPi / 180) / 65;
  for (int x = 16; x < 50; x += 3) {
    const double sine = (x - 32) * pixel;
    EXPECT_NEAR(image.rgb(x, 32).g, brightest * std::sqrt(std::max(0.0, 1 - sine * sine)), 2e-3) << x;
  }
  EXPECT_EQ(image.rgb(0, 0), (Rgb{0, 0, 0}));
}

TEST(DeviceRenderer, RegularGrids_AreThoseOfTheCpu) {
  Scene scene = ball_scene(make_library_shader("noise"));
  scene.lights = {lamp({3, 3, 5}, 60)};
  RenderOptions options;
  options.method = Method::kOriginal, options.spp = 16;
  const Image expected = Renderer(scene, options, std::vector<ObjectData>(1)).render(scene, 1).image;
  EXPECT_LT(compare_images(on_device(scene, by(Method::kSupersample, 16), {}), expected).rmse, 2e-3);
}

TEST(DeviceRenderer, GrainsThatTurn_AreThoseOfTheCpu) {
  Scene scene = ball_scene(make_library_shader("scratched_metal"));
  scene.lights = {lamp({3, 3, 5}, 60)};
  RenderOptions options;
  options.method = Method::kOriginal, options.spp = 4;
  const Image expected = Renderer(scene, options, std::vector<ObjectData>(1)).render(scene, 1).image;
  EXPECT_LT(compare_images(on_device(scene, by(Method::kOriginal, 4), {}), expected).mean_error, 2e-3);
}

TEST(DeviceRenderer, SeveralObjects_ShadowEachOtherAsOnTheCpu) {
  Scene scene = ball_scene(make_library_shader("checker"), 96);
  scene.objects.push_back(make_ball(make_library_shader("stone"), {1.2f, 0.9f, 1.6f}));
  scene.objects.back().transform.scale = 0.4f;
  scene.background = {0.1f, 0.2f, 0.3f};
  const Maps maps = {baked(scene.objects[0], 64), baked(scene.objects[1], 64)};
  // From outside one view does; among the objects it takes six.
  for (const Light& light : {sun({0.7f, 0.6f, 1}, true), lamp({3, 3, 4}, 50), lamp({1.6f, 1.3f, 2.4f}, 3)}) {
    scene.lights = {light, lamp({-4, 1, 5}, 20)};
    RenderOptions options;
    const Image expected = Renderer(scene, options, maps).render(scene, 1).image;
    const Comparison difference = compare_images(on_device(scene, by(Method::kMap), maps), expected);
    // What differs are the edges of shadows and balls.
    EXPECT_LT(difference.mean_error, 2e-3);
    EXPECT_LT(difference.rmse, 0.03);
  }
}

TEST(DeviceRenderer, FromInsideTheBoxOfAnObject_StillSeesIt) {
  Scene scene = ball_scene(make_library_shader("checker"));
  scene.camera.position = {0.95f, 0.9f, 0.95f};  // outside the ball, inside its box
  scene.lights = {lamp({3, 3, 3}, 30)};
  RenderOptions options;
  options.method = Method::kOriginal;
  const Image expected = Renderer(scene, options, std::vector<ObjectData>(1)).render(scene, 1).image;
  EXPECT_LT(compare_images(on_device(scene, by(Method::kOriginal), {}), expected).rmse, 0.01);
}

TEST(DeviceRenderer, OneBasisALight_IsTheMapsPictureOnAverage) {
  Scene scene = ball_scene(make_library_shader("checker"), 96);
  scene.lights = {lamp({3, 3, 5}, 60)};
  // Pixels so small that the surface does not turn in them: the mean normal is the normal.
  const Maps maps = {baked(scene.objects[0], 512)};
  DeviceRenderOptions options = by(Method::kMap);
  const Image expected = on_device(scene, options, maps);
  options.draws_one_basis = true;
  DeviceRenderer renderer(Device::open(), scene, options, maps);
  constexpr int kFrames = 36;
  Image mean(96, 96, 3);
  double one = 0;
  for (int frame = 1; frame <= kFrames; ++frame) {
    renderer.render(scene, frame);
    const Image image = renderer.picture();
    if (frame == 1) one = compare_images(image, expected).rmse;
    for (std::size_t i = 0; i < mean.data.size(); ++i) mean.data[i] += image.data[i] / kFrames;
  }
  EXPECT_GT(one, 0.005);
  // Noise falls with the square root of the frames.
  EXPECT_LT(compare_images(mean, expected).rmse, one / 4);
}

TEST(DeviceRenderer, WoodMixesCoatings_SoThatOneCallALightIsTheMapsPicture) {
  Scene scene = ball_scene(make_library_shader("wood"), 96);
  scene.lights = {lamp({3, 3, 5}, 60)};
  const Maps maps = {baked(scene.objects[0], 512)};
  ASSERT_GT(maps.front().map->basis.size(), 1u);
  DeviceRenderOptions options = by(Method::kMap);
  const Image expected = on_device(scene, options, maps);
  options.draws_one_basis = true;
  EXPECT_LT(compare_images(on_device(scene, options, maps), expected).rmse, 0.001);
}

TEST(DeviceRenderer, SameFrame_SameBytes_AlsoAfterAnotherSize) {
  Scene scene = ball_scene(make_library_shader("stone"));
  scene.lights = {lamp({3, 3, 5}, 60)};
  const Maps maps = {baked(scene.objects[0], 64)};
  DeviceRenderer renderer(Device::open(), scene, by(Method::kMap), maps);
  renderer.render(scene, 1);
  const Image first = renderer.picture();
  Scene larger = scene;
  larger.camera.width = 100, larger.camera.height = 70;
  renderer.render(larger, 1);
  EXPECT_EQ(renderer.picture().width, 100);
  renderer.render(scene, 1);
  EXPECT_EQ(renderer.picture().data, first.data);
}

TEST(DeviceRenderer, WhatItDoesNotTake_IsOneLine) {
  Scene scene = ball_scene(make_library_shader("white"), 8);
  const auto refused = [&](const DeviceRenderOptions& options, const Maps& maps) {
    return complaint([&] { on_device(scene, options, maps); });
  };
  EXPECT_NE(refused(by(Method::kPaper), {}).find("method paper: expected"), std::string::npos);
  EXPECT_NE(refused(by(Method::kSupersample, 7), {}).find("7 samples"), std::string::npos);
  EXPECT_NE(refused(by(Method::kMap), {ObjectData{}}).find("no reduction map"), std::string::npos);
  const Maps other = {baked(make_ball(make_library_shader("checker")), 8)};
  EXPECT_NE(refused(by(Method::kMap), other).find("from shader 'checker', not 'white'"), std::string::npos);
  scene.lights.assign(65, sun({0, 0, 1}, false));
  EXPECT_NE(refused(by(Method::kOriginal), {}).find("65 lights: expected at most 64"), std::string::npos);
}

/// Glass of one colour that reflects nothing.
std::shared_ptr<const Shader> plain_glass(const TemporaryFolder& folder) {
  const auto file = folder / "glass.glsl";
  std::ofstream(file) << "struct Parameters {\n  vec3 glass;  // 0.25 0.5 1 [0, 1]: part that passes\n};\n"
                         "struct Pattern { vec3 glass; };\n"
                         "Pattern pattern(Surface at, Parameters p) { return Pattern(p.glass); }\n"
                         "vec3 radiance(Pattern m, vec3 l, vec3 v) { return vec3(0.0); }\n"
                         "vec3 transmittance(Pattern m) { return m.glass; }\n";
  return make_user_shader(file, "glass.glsl");
}

TEST(DeviceRenderer, BehindGlass_IsWhatItLetsPass_SurfaceBySurface) {
  const TemporaryFolder folder;
  Scene scene = ball_scene(plain_glass(folder));
  scene.objects.push_back(make_ball(scene.objects[0].shader, {0, 0, -3}));
  scene.objects.push_back(make_ball(make_library_shader("white"), {0.2f, 0, -6}));
  scene.background = {0.6f, 0.8f, 1};
  const Image image = on_device(scene, by(Method::kOriginal, 1), {});
  // Two balls, in and out of each; the white one behind them is not lit.
  EXPECT_EQ(image.rgb(24, 24), (Rgb{0, 0, 0}));
  EXPECT_EQ(image.rgb(0, 0), scene.background);
  scene.objects.pop_back();
  const Rgb through = on_device(scene, by(Method::kOriginal, 1), {}).rgb(24, 24);
  EXPECT_NEAR(through.g, 0.8f * std::pow(0.5f, 4), 1e-6);
  EXPECT_NEAR(through.r, 0.6f * std::pow(0.25f, 4), 1e-6);
  EXPECT_NEAR(through.b, 1, 1e-6);
}

TEST(DeviceRenderer, LightThroughGlass_HasItsColour_OnBallsAndMeshesAlike) {
  const TemporaryFolder folder;
  Scene scene = ball_scene(make_library_shader("white"));
  scene.lights = {sun({0.8f, 0, 1}, true), lamp({-8, 0, 10}, 50)};
  const Rgb clear = on_device(scene, by(Method::kOriginal, 1), {}).rgb(24, 24);
  scene.lights.pop_back();
  const Rgb sun_alone = on_device(scene, by(Method::kOriginal, 1), {}).rgb(24, 24);
  scene.lights.push_back(lamp({-8, 0, 10}, 50));
  // In the way of the sun alone, outside the picture.
  scene.objects.push_back(make_ball(plain_glass(folder), {3.2f, 0, 5}));
  const Rgb once = on_device(scene, by(Method::kOriginal, 1), {}).rgb(24, 24);
  TriangleMesh mesh = icosphere(3);
  unwrap(mesh);
  scene.objects.back().surface = make_mesh_surface(std::move(mesh));
  const Rgb mesh_once = on_device(scene, by(Method::kOriginal, 1), {}).rgb(24, 24);
  for (const Rgb& found : {once, mesh_once}) {
    EXPECT_NEAR(found.r, clear.r - sun_alone.r * (1 - 0.0625f), 2e-4 * clear.r);
    EXPECT_NEAR(found.g, clear.g - sun_alone.g * (1 - 0.25f), 2e-4 * clear.g);
    EXPECT_NEAR(found.b, clear.b, 2e-4 * clear.b);
  }
}

TEST(DeviceRenderer, BlackBoxThatHidesItsNormals_LooksAsOnTheCpu) {
  const TemporaryFolder folder;
  const auto file = folder / "bumps.glsl";
  std::ofstream(file) << "struct Parameters {\n  float bumps;  // 9 [1, 50]: bumps\n};\n"
                         "vec3 radiance(Surface at, Parameters p, vec3 to_light, vec3 to_viewer) {\n"
                         "  vec3 n = normalize(at.normal + 0.3 * sin(p.bumps * at.position.yzx));\n"
                         "  float shine = pow(max(dot(n, normalize(to_light + to_viewer)), 0.0), 30.0);\n"
                         "  return (vec3(0.2, 0.1, 0.05) + 0.4 * shine) * max(dot(n, to_light), 0.0);\n}\n";
  Scene scene = ball_scene(make_user_shader(file, "bumps.glsl"));
  scene.lights = {lamp({3, 3, 5}, 60)};
  const ObjectData data = baked(scene.objects[0], 64);
  ASSERT_TRUE(data.map->hides_frames);
  RenderOptions options;
  options.method = Method::kMap;
  const Image expected = Renderer(scene, options, {data}).render(scene, 1).image;
  EXPECT_LT(compare_images(on_device(scene, by(Method::kMap), {data}), expected).mean_error, 1e-3);
}

/// Averaged parameters of a ball's shader, and slopes where it perturbs normals.
ObjectData averaged(const Object& ball, int size) {
  ObjectData data;
  data.parameters = std::make_shared<const Pyramid<float>>(build_parameter_pyramid(*ball.surface, *ball.shader, size));
  if (ball.shader->info().perturbs_normals)
    data.slopes = std::make_shared<const Pyramid<float>>(build_slope_pyramid(*ball.surface, *ball.shader, size));
  return data;
}

TEST(DeviceRenderer, AveragedParameters_LookAsOnTheCpu) {
  for (const char* name : {"checker", "stone", "brick", "scales", "transparent"}) {
    Scene scene = ball_scene(make_library_shader(name), 96);
    scene.lights = {lamp({3, 3, 5}, 60), lamp({-4, 1, 5}, 20)};
    const ObjectData data = averaged(scene.objects[0], 512);
    RenderOptions options;
    options.method = Method::kParameters;
    const Image expected = Renderer(scene, options, {data}).render(scene, 1).image;
    const Comparison difference = compare_images(on_device(scene, by(Method::kParameters), {data}), expected);
    EXPECT_LT(difference.mean_error, 1e-3) << name;
    const Image other = on_device(scene, by(Method::kOriginal), {});
    EXPECT_GT(compare_images(other, expected).mean_error, 3 * difference.mean_error) << name;
  }
}

TEST(DeviceRenderer, ShaderThatDoesNotEnd_IsNamed) {
  const TemporaryFolder folder;
  const auto file = folder / "endless.glsl";
  std::ofstream(file) << "struct Parameters {\n  float a;  // 1 [0, 2]: a\n};\nstruct Pattern { vec3 c; };\n"
                         "Pattern pattern(Surface at, Parameters p) {\n  float x = p.a;\n"
                         "  while (x > 0.0) x += 1.0;\n  return Pattern(vec3(x));\n}\n"
                         "vec3 radiance(Pattern m, vec3 l, vec3 v) { return m.c * l.z; }\n";
  Scene scene = ball_scene(make_user_shader(file, "endless.glsl"), 8);
  scene.lights = {sun({0, 0, 1}, false)};
  const std::string found = complaint([&] { on_device(scene, by(Method::kOriginal), {}); });
  EXPECT_NE(found.find("shader \"endless.glsl\": pattern(): expected loops that end"), std::string::npos) << found;
}

}  // namespace
}  // namespace redmap
