// What a scene may set, and what it is told when it may not.
#include "shader/parameter_values.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "base/error.h"
#include "shader_test_support.h"

namespace redmap {
namespace {

using testing::HasSubstr;

std::string error_of(const std::string& shader, const ParameterOverrides& overrides) {
  try {
    make_library_shader(shader, overrides);
  } catch (const Error& error) {
    return error.what();
  }
  return "no error";
}

TEST(ParameterValues, OverridesReachTheShader) {
  const auto bound = make_library_shader("white", {{"albedo", {0.25f}}})->bind(test::random_points(8, 1));
  const DirectionPairs pairs = test::random_pairs(8, 2);
  Planes<3> out;
  bound->radiance_each(pairs, out);
  for (std::size_t i = 0; i < 8; ++i) EXPECT_NEAR(out[1][i], 0.25f * pairs.to_light[2][i] / kPi, 1e-7f);
}

TEST(ParameterValues, EveryComponentReachesItsPlace) {
  // Both kinds of cube the same, black but for one channel each time.
  for (int channel = 0; channel < 3; ++channel) {
    std::vector<float> colour(3, 0.0f);
    colour[static_cast<std::size_t>(channel)] = 1;
    const auto bound =
        make_library_shader("checker", {{"dark", colour}, {"light", colour}})->bind(test::random_points(64, 1));
    Materials materials;
    ASSERT_TRUE(bound->materials(materials));
    for (std::size_t i = 0; i < 64; ++i)
      for (int c = 0; c < 3; ++c) EXPECT_EQ(materials.diffuse[c][i], c == channel ? 1 : 0);
  }
}

TEST(ParameterValues, RefusesWhatTheTextDoesNotDeclare) {
  EXPECT_THAT(error_of("noise", {{"scal", {3}}}), testing::AllOf(HasSubstr("'scal'"), HasSubstr("'scale'")));
  EXPECT_THAT(error_of("nois", {}), testing::AllOf(HasSubstr("'nois'"), HasSubstr("'noise'")));
  EXPECT_THAT(error_of("noise", {{"scale", {3, 4}}}), HasSubstr("takes 1 number(s), found 2"));
  EXPECT_THAT(error_of("noise", {{"blue", {1}}}), HasSubstr("takes 3 number(s), found 1"));
  EXPECT_THAT(error_of("noise", {{"scale", {-3}}}), HasSubstr("[0.1, 1000], found -3"));
  EXPECT_THAT(error_of("noise", {{"scale", {NAN}}}), HasSubstr("found nan"));
  EXPECT_THAT(error_of("noise", {{"scale", {INFINITY}}}), HasSubstr("found inf"));
}

TEST(ParameterValues, IntsMustBeWhole) {
  ShaderInfo info;
  info.parameters = {{"octaves", "int", {3}, 1, 8, "", ""}};
  EXPECT_EQ(parameter_values(info, {{"octaves", {5}}}), (ParameterValues{{5}}));
  EXPECT_THROW(parameter_values(info, {{"octaves", {2.5f}}}), Error);
}

}  // namespace
}  // namespace redmap
