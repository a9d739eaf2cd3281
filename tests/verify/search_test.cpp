#include "verify/search.h"

#include <gtest/gtest.h>

#include <algorithm>

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

TEST(Search, FlipThatWasAsked_IsKept_AndTheSmallestMapDoesNot) {
  SearchOptions options = options_for(0, 256);
  options.max_flip = 0.25;
  const SearchResult result = search_smallest_map(ball("marble"), options);
  EXPECT_GT(result.map.size, 16);
  // The last steps may be larger tolerances that were tried in vain.
  EXPECT_TRUE(std::any_of(result.steps.begin(), result.steps.end(), [&](const SearchStep& step) {
    return step.size == result.map.size && step.basis == result.map.basis.size() && step.flip_bound <= 0.25;
  }));
  EXPECT_EQ(result.steps.front().size, 16);
  EXPECT_GT(result.steps.front().flip_bound, 0.25);
}

TEST(Search, OfTwoLimits_TheHarderDecides) {
  const auto size = [](double max_error, double max_flip) {
    SearchOptions options = options_for(max_error, 256);
    options.max_flip = max_flip, options.verify.pixels = 40;
    return search_smallest_map(ball("noise"), options).map.size;
  };
  const int error_alone = size(0.2, 0), flip_alone = size(0, 0.4);
  EXPECT_NE(error_alone, flip_alone);
  EXPECT_EQ(size(0.2, 0.4), std::max(error_alone, flip_alone));
}

TEST(Search, RefusalOfAFlip_NamesIt) {
  SearchOptions options = options_for(0, 64);
  options.max_flip = 1e-5;
  try {
    search_smallest_map(ball("scales"), options);
    FAIL() << "expected Error";
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("a FLIP error of 1e-05"), std::string::npos) << error.what();
    EXPECT_EQ(std::string(error.what()).find("an error of"), std::string::npos) << error.what();
  }
}

TEST(Search, LimitsThatAreNone_AreRefused) {
  SearchOptions options = options_for(0.1, 64);
  options.max_flip = -1;
  EXPECT_THROW(search_smallest_map(ball("white"), options), Error);
}

TEST(Search, ErrorOfNothing_IsRefused) { EXPECT_THROW(search_smallest_map(ball("white"), options_for(0, 64)), Error); }

}  // namespace
}  // namespace redmap
