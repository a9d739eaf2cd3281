// Map sizes that follow from what the camera sees, on spheres, where they are known.
#include "render/closest_view.h"

#include <gtest/gtest.h>

#include <cmath>

#include "scene/scene_test_support.h"
#include "surface/map_size.h"

namespace redmap {
namespace {

constexpr const char* kCamera = "[camera]\nposition = [0, 0, 6]\nfov = 24\nwidth = 640\nheight = 640\n";

std::string ball(const std::string& name, const std::string& keys) {
  return "[object." + name + "]\nsurface = 'sphere'\nshader = 'noise'\n" + keys + "\n";
}

/// Texels from pole to pole that the near side of a sphere at the origin needs, of radius 1.
double needed(double distance) { return kPi / ((distance - 1) * 2 * std::tan(12 * kPi / 180) / 640); }

class ClosestView : public testing::Test {
 protected:
  SceneFile load(const std::string& text) { return SceneFile::load(write(folder_, "a.toml", text)); }
  TemporaryFolder folder_;
};

TEST_F(ClosestView, TexelsAreAsFineAsThePixelsOfTheNearestPlace) {
  for (const double distance : {3.0, 6.0, 11.0, 40.0}) {
    SceneFile file = load("[camera]\nposition = [0, 0, " + std::to_string(distance) +
                          "]\nfov = 24\nwidth = 640\nheight = 640\n" + ball("a", "map_size = 'auto'"));
    ASSERT_EQ(settle_map_sizes(file).size(), 1u);
    const double size = file.at(1).objects[0].map_size;
    EXPECT_GE(size, 0.97 * needed(distance)) << distance;
    EXPECT_LT(size, 2 * needed(distance)) << distance;
  }
}

TEST_F(ClosestView, TheNearestFrameCounts) {
  SceneFile file = load(std::string(kCamera) + ball("a", "map_size = 'auto'") +
                        "[animation]\nframes = 9\n[[animation.key]]\ntarget = 'camera.position'\nframe = 2\n"
                        "value = [0, 0, 60]\n[[animation.key]]\ntarget = 'camera.position'\nframe = 9\n"
                        "value = [0, 0, 3]\n");
  const std::vector<SettledMapSize> settled = settle_map_sizes(file);
  ASSERT_EQ(settled.size(), 1u);
  EXPECT_EQ(file.at(1).objects[0].map_size, map_size_of_at_least(needed(3)));
  EXPECT_NE(settled[0].reason.find("frame 9"), std::string::npos) << settled[0].reason;
}

TEST_F(ClosestView, FourTimesAsLargeAndFarAwayNeedsAsMuch) {
  SceneFile file = load(std::string(kCamera) + ball("a", "map_size = 'auto'\nscale = 4\ntranslate = [0, 0, -13]"));
  settle_map_sizes(file);
  EXPECT_EQ(file.at(1).objects[0].map_size, map_size_of_at_least(needed(1 + 15.0 / 4)));
}

TEST_F(ClosestView, WhatIsUnseenHasTheDefault_AndNumbersStay) {
  SceneFile file = load(std::string(kCamera) + ball("behind", "map_size = 'auto'\ntranslate = [0, 0, 30]") +
                        ball("given", "map_size = 77"));
  EXPECT_EQ(settle_map_sizes(file).size(), 1u);
  EXPECT_EQ(file.at(1).objects[0].map_size, 1024);
  EXPECT_EQ(file.at(1).objects[1].map_size, 77);
}

TEST_F(ClosestView, ObjectsThatShareAMapHaveTheLargerSize) {
  SceneFile file = load(std::string(kCamera) + ball("near", "map_size = 'auto'\nmap = 'm.exr'") +
                        ball("far", "map_size = 'auto'\nmap = 'm.exr'\ntranslate = [3, 0, -30]"));
  settle_map_sizes(file);
  EXPECT_EQ(file.at(1).objects[1].map_size, file.at(1).objects[0].map_size);
}

TEST_F(ClosestView, DensityDecidesWhereItIsAskedFor) {
  // A sphere's map of size N has 2 N^2 texels on 4 pi r^2.
  SceneFile file = load(std::string(kCamera) + ball("a", "radius = 2\ntexels_per_unit = 100"));
  settle_map_sizes(file);
  EXPECT_EQ(file.at(1).objects[0].map_size, map_size_of_at_least(100 * 2 * std::sqrt(2 * kPi)));
}

TEST(MapSize, IsAPowerOfTwoWithinItsRange) {
  EXPECT_EQ(map_size_of_at_least(0), 16);
  EXPECT_EQ(map_size_of_at_least(256), 256);
  EXPECT_EQ(map_size_of_at_least(257), 512);
  EXPECT_EQ(map_size_of_at_least(1e9), 16384);
  EXPECT_EQ(map_size_for_density(4, 0.25, 100), 512);
}

}  // namespace
}  // namespace redmap
