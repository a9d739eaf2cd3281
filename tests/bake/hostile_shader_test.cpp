// Shaders that return what is no number: the bake ends with the shader's name and the place.
#include <gtest/gtest.h>

#include <limits>
#include <string>

#include "bake/bake.h"
#include "base/parallel.h"
#include "planted.h"

namespace redmap {
namespace {

std::string complaint(const PlantedWeights& weights) {
  BakeOptions options;
  options.size = 64;
  try {
    bake(SquareSurface(), PlantedShader(weights), options);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(HostileShader, NotANumberOrInfinity_IsNamedWithItsPlace_ForAnyNumberOfThreads) {
  for (const float bad : {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity(), -1e30f})
    for (const std::size_t threads : {1, 2, 7}) {
      const ThreadLimit limit(threads);
      // One texel of the lower right quarter, another later on.
      const std::string found = complaint([&](Vec3 p) {
        const bool unsound = p.x > 0.75f && p.y > 0.25f && (p.y < 0.265f || p.y > 0.6f);
        return Vec3{unsound ? bad : 1.0f, 0, 0};
      });
      EXPECT_NE(found.find("shader \"planted\""), std::string::npos) << found;
      EXPECT_NE(found.find("position (0.7"), std::string::npos) << found;
      EXPECT_NE(found.find(", 0.25"), std::string::npos) << found;
    }
}

TEST(HostileShader, WhatHidesBetweenTexelCentres_IsFoundAmongTheSubSamples) {
  const std::string found = complaint([](Vec3 p) {
    const float x = 64 * p.x, y = 64 * p.y;
    if (x > 20.5f && x < 20.74f && y > 30.76f && y < 31) return Vec3{std::numeric_limits<float>::quiet_NaN(), 0, 0};
    return x < 20 ? Vec3{1, 0, 0} : Vec3{0, 1, 0};
  });
  EXPECT_NE(found.find("position (0.32"), std::string::npos) << found;
}

TEST(HostileShader, LargeButSoundValues_AreBaked) {
  EXPECT_EQ(complaint([](Vec3 p) { return Vec3{p.x < 0.5f ? 1e15f : 1.0f, 0, 0}; }), "");
}

}  // namespace
}  // namespace redmap
