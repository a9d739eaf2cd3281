#include "verify/search.h"

#include <gtest/gtest.h>

#include "base/error.h"

namespace redmap {
namespace {

Object ball(const std::string& shader) {
  Object object;
  object.name = "ball";
  object.surface = make_sphere(1);
  object.shader = make_library_shader(shader);
  return object;
}

SearchOptions options_for(double max_error, int largest) {
  SearchOptions options;
  options.max_error = max_error;
  options.bake.size = largest;
  options.verify.pixels = 60, options.verify.spp = 128;
  return options;
}

std::string refusal(const std::string& shader, double max_error, int largest) {
  try {
    search_smallest_map(ball(shader), options_for(max_error, largest));
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(Search, WhiteLambert_NeedsTheSmallestMap_AndOneMaterial) {
  const SearchResult result = search_smallest_map(ball("white"), options_for(0.05, 256));
  EXPECT_EQ(result.map.size, 16);
  EXPECT_EQ(result.map.basis.size(), 1u);
}

TEST(Search, MapThatIsFound_KeepsTheError_AndTheSizeBelowDoesNot) {
  const SearchResult result = search_smallest_map(ball("marble"), options_for(0.04, 1024));
  ASSERT_TRUE(result.map.certificate);
  EXPECT_LE(largest_bound(*result.map.certificate), 0.04f);
  EXPECT_GT(result.map.size, 16);
  ASSERT_GE(result.steps.size(), 3u);
  for (const SearchStep& step : result.steps)
    if (step.size < result.map.size) {
      EXPECT_GT(step.bound, 0.04) << step.size;
    }
}

TEST(Search, SmallerError_TakesALargerMap) {
  const auto bytes = [](double max_error) {
    return texel_bytes(search_smallest_map(ball("marble"), options_for(max_error, 1024)).map);
  };
  EXPECT_LT(bytes(0.1), bytes(0.03));
}

TEST(Search, WhatNoMapKeeps_IsRefusedWithTheReason) {
  const std::string reason = refusal("scales", 1e-5, 256);
  EXPECT_NE(reason.find("ball"), std::string::npos) << reason;
  EXPECT_NE(reason.find("most of it from"), std::string::npos) << reason;
}

TEST(Search, ShaderThatVariesInTime_IsRefusedAtOnce) {
  const std::string reason = refusal("pulsing", 0.1, 64);
  EXPECT_NE(reason.find("time"), std::string::npos) << reason;
}

TEST(Search, ErrorOfNothing_IsRefused) { EXPECT_THROW(search_smallest_map(ball("white"), options_for(0, 64)), Error); }

}  // namespace
}  // namespace redmap
