#include "render/renderer.h"

#include <gtest/gtest.h>

#include <cmath>

#include "bake/bake.h"
#include "bake/baselines.h"
#include "base/error.h"
#include "base/parallel.h"
#include "render_test_support.h"
#include "scene/camera_rays.h"

namespace redmap {
namespace {

using test::alternating_map;
using test::LambertShader;
using test::sphere_scene;

constexpr BasisPlace kEast{{1, 0, 0}, {1, 0, 0}, {0, 0, 1}, {0, 0.5f}};
constexpr BasisPlace kWest{{-1, 0, 0}, {-1, 0, 0}, {0, 0, -1}, {0.5f, 0.5f}};

RenderOptions with(Method method, Quality quality = Quality::kDefault, int spp = 0) {
  RenderOptions options;
  options.method = method;
  options.quality = quality;
  options.spp = spp;
  return options;
}

RenderedFrame render(const Scene& scene, const RenderOptions& options, ObjectData data = {}) {
  return Renderer(scene, options, std::vector<ObjectData>(scene.objects.size(), data)).render(scene, 1);
}

/// Where the ray through the centre of pixel (x, y) meets the unit sphere, if it does.
std::optional<Vec3> sphere_point(const Camera& camera, int x, int y) {
  const CameraRays rays = make_camera_rays(camera);
  const Vec3 d = normalized(rays.unnormalised(static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f));
  const float b = dot(rays.origin, d), c = dot(rays.origin, rays.origin) - 1, discriminant = b * b - c;
  if (discriminant < 0) return std::nullopt;
  return rays.origin + d * (-b - std::sqrt(discriminant));
}

TEST(Renderer, LambertSphere_IsCosineOverPi) {
  const Vec3 to_light = normalized({1, 2, 3});
  const Scene scene = sphere_scene(std::make_shared<LambertShader>(0.8f, 0.0f), to_light);
  const Image image = render(scene, with(Method::kOriginal, Quality::kDefault, 1)).image;
  int lit = 0;
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) {
      const auto normal = sphere_point(scene.camera, x, y);
      const float expected = normal ? 0.8f * std::max(0.0f, dot(*normal, to_light)) / kPi : 0;
      ASSERT_NEAR(image.at(x, y, 0), expected, 2e-5f) << x << " " << y;
      lit += expected > 0.1f;
    }
  EXPECT_GT(lit, 500);
}

TEST(Renderer, PointLight_FallsWithTheSquareOfItsDistance) {
  Scene scene = sphere_scene(std::make_shared<LambertShader>(1.0f, 0.0f), {0, 0, 1}, 33);
  scene.lights[0].type = Light::Type::kPoint;
  scene.lights[0].position = {0, 0, 3};
  scene.lights[0].intensity = {4, 4, 4};
  const Image image = render(scene, with(Method::kOriginal, Quality::kDefault, 1)).image;
  EXPECT_NEAR(image.at(16, 16, 0), 4 / (2.0f * 2.0f) / kPi, 1e-4f);
}

TEST(Renderer, BallBetweenLightAndBall_CastsABlackShadow) {
  Scene scene = sphere_scene(std::make_shared<LambertShader>(1.0f, 0.0f), {0, 1, 1}, 33);
  Object blocker = scene.objects[0];
  blocker.transform.scale = 0.5f;
  blocker.transform.translate = {0, 3, 4};
  scene.objects.push_back(blocker);
  EXPECT_EQ(render(scene, with(Method::kOriginal)).image.at(16, 16, 0), 0);
  scene.lights[0].shadows = false;
  EXPECT_NEAR(render(scene, with(Method::kOriginal)).image.at(16, 16, 0), std::sqrt(0.5f) / kPi, 1e-3f);
}

TEST(Renderer, HalfTransparentBall_ShowsAQuarterOfTheBackgroundThroughItsTwoWalls) {
  Scene scene = sphere_scene(std::make_shared<LambertShader>(0.0f, 0.5f), {0, 0, 1}, 33);
  scene.background = {0.8f, 0.4f, 0.2f};
  const Image image = render(scene, with(Method::kOriginal)).image;
  EXPECT_NEAR(image.at(16, 16, 0), 0.2f, 1e-6f);
  EXPECT_NEAR(image.at(16, 16, 1), 0.1f, 1e-6f);
  EXPECT_NEAR(image.at(0, 0, 2), 0.2f, 1e-6f);
}

TEST(Renderer, LightThroughAHalfTransparentBall_LosesThreeQuarters) {
  Scene scene = sphere_scene(std::make_shared<LambertShader>(1.0f, 0.0f), {0, 1, 1}, 33);
  Object filter = scene.objects[0];
  filter.shader = std::make_shared<LambertShader>(0.0f, 0.5f);
  filter.transform.scale = 0.5f;
  filter.transform.translate = {0, 3, 4};
  scene.objects.push_back(filter);
  EXPECT_NEAR(render(scene, with(Method::kOriginal)).image.at(16, 16, 0), 0.25f * std::sqrt(0.5f) / kPi, 1e-3f);
}

TEST(Renderer, AnyNumberOfThreads_GivesTheSameBytes) {
  Scene scene = sphere_scene(make_library_shader("noise"), {1, 1, 1}, 100);
  const auto map = alternating_map(scene.objects[0], kEast, kWest, 256);
  for (const RenderOptions& options :
       {with(Method::kMap), with(Method::kMap, Quality::kFast), with(Method::kMap, Quality::kBalanced),
        with(Method::kSupersample, Quality::kDefault, 5)}) {
    std::vector<float> first;
    for (std::size_t threads : {1, 2, 7}) {
      const ThreadLimit limit(threads);
      const Image image = render(scene, options, {map, nullptr, nullptr}).image;
      if (first.empty()) first = image.data;
      EXPECT_EQ(image.data, first) << threads;
    }
  }
}

TEST(Renderer, MapUnderHalfATexel_IsTheShaderBitForBit) {
  Scene scene = sphere_scene(make_library_shader("checker"), {1, 1, 1}, 96);
  scene.camera.vertical_fov_degrees = 12;  // the rim, where footprints are long, stays outside
  const auto map = alternating_map(scene.objects[0], kEast, kWest, 32);
  for (Quality quality : {Quality::kFast, Quality::kBalanced, Quality::kDefault})
    EXPECT_EQ(render(scene, with(Method::kMap, quality), {map, nullptr, nullptr}).image.data,
              render(scene, with(Method::kOriginal, quality)).image.data);
}

TEST(Renderer, MapOfTwoAlternatingBases_IsTheirMeanFarAway) {
  Scene scene = sphere_scene(make_library_shader("checker"), {0, 0, 1}, 9);
  scene.camera.position = {0, 0, 40};
  scene.camera.vertical_fov_degrees = 1;
  const auto map = alternating_map(scene.objects[0], kEast, kWest, 1024);
  const Image mixed = render(scene, with(Method::kMap), {map, nullptr, nullptr}).image;
  auto only = [&](BasisPlace place) {
    return render(scene, with(Method::kMap), {alternating_map(scene.objects[0], place, place, 1024), nullptr, nullptr})
        .image;
  };
  const Image east = only(kEast), west = only(kWest);
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(mixed.at(4, 4, c), 0.5f * (east.at(4, 4, c) + west.at(4, 4, c)), 0.005f) << c;
}

TEST(Renderer, BalancedQuality_ShowsWhatDefaultDoes_ForLessThanHalfOfItsCalls) {
  const Scene scene = sphere_scene(make_library_shader("checker"), {1, 1, 1}, 64);
  BakeOptions bake_options;
  bake_options.size = 512;
  const auto map =
      std::make_shared<const ReductionMap>(bake(*scene.objects[0].surface, *scene.objects[0].shader, bake_options));
  const auto frame = [&](Quality quality) {
    return render(scene, with(Method::kMap, quality), {map, nullptr, nullptr});
  };
  const RenderedFrame balanced = frame(Quality::kBalanced), reference = frame(Quality::kDefault);
  EXPECT_LT(balanced.counts.shader_calls, reference.counts.shader_calls / 2);
  double squares = 0;
  for (std::size_t i = 0; i < balanced.image.data.size(); ++i)
    squares += std::pow(balanced.image.data[i] - reference.image.data[i], 2);
  EXPECT_LT(std::sqrt(squares / static_cast<double>(balanced.image.data.size())), 0.01);
}

TEST(Renderer, WhiteMapByThePaper_IsWhite) {
  Scene scene = sphere_scene(make_library_shader("white"), {0, 0, 1}, 21);
  const auto map = alternating_map(scene.objects[0], kEast, kWest, 512);
  const auto normals = std::make_shared<const Pyramid<float>>(
      build_normal_pyramid(*scene.objects[0].surface, *scene.objects[0].shader, 512));
  const Image paper = render(scene, with(Method::kPaper), {map, nullptr, normals}).image;
  const Image original = render(scene, with(Method::kOriginal, Quality::kDefault, 1)).image;
  for (int y = 7; y < 14; ++y)
    for (int x = 7; x < 14; ++x) EXPECT_NEAR(paper.at(x, y, 0), original.at(x, y, 0), 0.01f) << x << " " << y;
}

TEST(Renderer, MapThatDoesNotReduce_IsSupersampledAndCounted) {
  Scene scene = sphere_scene(make_library_shader("checker"), {0, 0, 1}, 33);
  ReductionMap map = *alternating_map(scene.objects[0], kEast, kWest, 256);
  map.verdict = MapVerdict::kDoesNotReduce;
  const RenderedFrame frame =
      render(scene, with(Method::kMap), {std::make_shared<const ReductionMap>(map), nullptr, nullptr});
  EXPECT_GT(frame.counts.supersampled_pixels, 200u);
  EXPECT_EQ(frame.counts.lookups, 0u);
}

TEST(Renderer, MapOfAnotherShader_IsRefused) {
  const Scene noise = sphere_scene(make_library_shader("noise"), {0, 0, 1});
  const Scene checker = sphere_scene(make_library_shader("checker"), {0, 0, 1});
  const auto map = alternating_map(noise.objects[0], kEast, kWest, 64);
  EXPECT_THROW(render(checker, with(Method::kMap), {map, nullptr, nullptr}), Error);
  EXPECT_THROW(render(checker, with(Method::kMap)), Error);
}

TEST(Renderer, Classes_TellInteriorFromSilhouetteAndBackground) {
  const Scene scene = sphere_scene(std::make_shared<LambertShader>(1.0f, 0.0f), {0, 0, 1}, 64);
  RenderOptions options = with(Method::kSupersample, Quality::kDefault, 64);
  options.classify = true;
  const RenderedFrame frame = render(scene, options);
  EXPECT_EQ(frame.classes[32 * 64 + 32], PixelClass::kInterior);
  EXPECT_EQ(frame.classes[0], PixelClass::kBackground);
  std::size_t silhouette = 0;
  for (PixelClass c : frame.classes) silhouette += c == PixelClass::kSilhouette;
  EXPECT_GT(silhouette, 50u);
  EXPECT_LT(silhouette, 400u);
}

TEST(Strata, AreAsSquareAsTheNumberAllows) {
  EXPECT_EQ(strata_of(16).columns, 4);
  EXPECT_EQ(strata_of(8).columns, 4);
  EXPECT_EQ(strata_of(8).rows, 2);
  EXPECT_EQ(strata_of(7).rows, 1);
}

}  // namespace
}  // namespace redmap
