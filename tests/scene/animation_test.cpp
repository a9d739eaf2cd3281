// Interpolation between keys: known answers.
#include "scene/animation.h"

#include <gtest/gtest.h>

#include <cmath>

namespace redmap {
namespace {

TEST(Interpolate, BetweenTwoKeys_IsTheStraightLine_AndHeldOutside) {
  const std::vector<AnimationKey> keys{{10, {0, 1, 2}}, {20, {10, 1, -2}}};
  EXPECT_EQ(interpolate(keys, 15), (Vec3{5, 1, 0}));
  EXPECT_EQ(interpolate(keys, 10), (Vec3{0, 1, 2}));
  EXPECT_EQ(interpolate(keys, 20), (Vec3{10, 1, -2}));
  EXPECT_EQ(interpolate(keys, 1), (Vec3{0, 1, 2}));
  EXPECT_EQ(interpolate(keys, 1000), (Vec3{10, 1, -2}));
}

TEST(Interpolate, EveryKey_IsMetExactly) {
  std::vector<AnimationKey> keys;
  for (int i = 0; i < 20; ++i) keys.push_back({1 + i * i, {0.1f * static_cast<float>(i), 1.0f / 3.0f, -0.7f}});
  for (const AnimationKey& key : keys) EXPECT_EQ(interpolate(keys, key.frame), key.value);
}

TEST(Interpolate, OneKey_HoldsEverywhere) {
  for (int frame : {1, 5, 9}) EXPECT_EQ(interpolate({{5, {1, 2, 3}}}, frame), (Vec3{1, 2, 3}));
}

TEST(Animate, TurntableAddsToTheRotation_AndTimeStartsAtFrameOne) {
  Scene rest;
  rest.objects.resize(2);
  rest.objects[1].transform.rotate_degrees = {5, 10, 0};
  Animation animation;
  animation.frame_count = 100;
  animation.frames_per_second = 25;
  animation.turntable = Turntable{1, 2.5f};
  EXPECT_EQ(animate(rest, animation, 1).objects[1].transform.rotate_degrees, (Vec3{5, 10, 0}));
  const Scene later = animate(rest, animation, 51);
  EXPECT_EQ(later.objects[1].transform.rotate_degrees, (Vec3{5, 135, 0}));
  EXPECT_EQ(later.objects[0].transform.rotate_degrees, Vec3{});
  EXPECT_FLOAT_EQ(later.time_seconds, 2);
  EXPECT_EQ(animate(rest, animation, 1).time_seconds, 0);
}

TEST(Animate, AWholeTurn_EndsWhereItBegan_HoweverManyFrames) {
  Scene rest;
  rest.objects.resize(1);
  rest.objects[0].transform.rotate_degrees.y = 10;
  Animation animation;
  animation.turntable = Turntable{0, 22.5f};
  EXPECT_EQ(animate(rest, animation, 17).objects[0].transform.rotate_degrees.y, 10);
  // 22.5 degrees a frame and a little: after 100 000 frames a float would be off by a tenth of a degree.
  animation.turntable->degrees_per_frame = 22.5f + 0x1p-12f;
  const double turned = std::fmod((22.5 + 0x1p-12) * 99'999, 360.0);
  EXPECT_FLOAT_EQ(animate(rest, animation, 100'000).objects[0].transform.rotate_degrees.y,
                  static_cast<float>(10 + turned));
}

TEST(Animate, DirectionsToLights_AreUnitVectors) {
  Scene rest;
  rest.lights.push_back({.type = Light::Type::kDirectional, .name = "sun", .position = {}, .to_light = {3, 0, 4}});
  const Vec3 to_light = animate(rest, {}, 1).lights[0].to_light;
  EXPECT_FLOAT_EQ(to_light.x, 0.6f);
  EXPECT_FLOAT_EQ(to_light.z, 0.8f);
}

}  // namespace
}  // namespace redmap
