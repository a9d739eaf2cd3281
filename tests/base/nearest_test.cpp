// Suggestions for mistyped names.
#include "base/nearest.h"

#include <gtest/gtest.h>

#include <vector>

namespace redmap {
namespace {

const std::vector<std::string> kNames = {"noise", "scales", "stone", "wood"};

TEST(Nearest, OneEditAway_IsFound) {
  EXPECT_EQ(nearest("nois", kNames), "noise");
  EXPECT_EQ(nearest("scalse", kNames), "scales");
  EXPECT_EQ(nearest("stome", kNames), "stone");
  EXPECT_EQ(nearest("wood", kNames), "wood");
}

TEST(Nearest, Ties_GoToTheFirst) { EXPECT_EQ(nearest("", std::vector<std::string>{"ab", "cd", "a", "b"}), "a"); }

TEST(Nearest, NoCandidates_GiveNothing) { EXPECT_EQ(nearest("noise", {}), ""); }

}  // namespace
}  // namespace redmap
