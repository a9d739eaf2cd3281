#include "export/live_parameters.h"

#include <gtest/gtest.h>

#include "export_test_support.h"

namespace redmap {
namespace {

TEST(LiveParameters, ColoursAndGlossOfTheParts_ButNotWhatMovesTheirBorder) {
  const ExportInput input = small_input("noise", 64);
  // scale, threshold, blue, yellow, blue_exponent, yellow_roughness
  EXPECT_EQ(live_parameters(*input.map, *input.surface, *input.shader),
            (std::vector<bool>{false, false, true, true, true, true}));
}

TEST(LiveParameters, HeightOfBumps_IsInTheNormalsOfTheMap) {
  const ExportInput input = small_input("raised_scales", 64);
  const auto& parameters = input.shader->info().parameters;
  const std::vector<bool> live = live_parameters(*input.map, *input.surface, *input.shader);
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    const std::string& name = parameters[i].name;
    if (name == "height" || name == "green") {
      EXPECT_EQ(live[i], name == "green") << name;
    }
  }
}

}  // namespace
}  // namespace redmap
