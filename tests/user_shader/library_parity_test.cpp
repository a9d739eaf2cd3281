// Every library shader, as a file of the user's own, agrees with what is compiled in: two compilers, two ways to run.
#include <gtest/gtest.h>

#include <cmath>

#include "shader/shader_test_support.h"
#include "user_shader/user_shader.h"

namespace redmap {
namespace {

class LibraryParity : public testing::TestWithParam<std::string> {
 protected:
  std::shared_ptr<const Shader> library_ = make_library_shader(GetParam());
  std::shared_ptr<const Shader> user_ =
      make_user_shader(std::string(REDMAP_SHADERS) + "/" + GetParam() + ".glsl", GetParam() + ".glsl");
};
INSTANTIATE_TEST_SUITE_P(Library, LibraryParity, testing::ValuesIn(library_shader_names()),
                         [](const auto& test) { return test.param; });

/// Part of the values that differ by more than `tolerance`. A few places lie so close to an edge of the pattern that
/// the last bit decides.
double part_that_differs(const Planes<3>& a, const Planes<3>& b, float tolerance) {
  std::size_t differ = 0;
  for (int c = 0; c < 3; ++c)
    for (std::size_t i = 0; i < a.size(); ++i)
      differ += !(std::abs(a[c][i] - b[c][i]) <= tolerance * (1 + std::abs(a[c][i])));
  return static_cast<double>(differ) / (3.0 * static_cast<double>(a.size()));
}

TEST_P(LibraryParity, DeclarationsRadianceNormalsAndConstantsAgree) {
  const ShaderInfo &info = library_->info(), &own = user_->info();
  EXPECT_EQ(info.summary, own.summary);
  EXPECT_EQ(info.parameters.size(), own.parameters.size());
  EXPECT_EQ(library_->parameters(), user_->parameters());
  EXPECT_EQ(info.black_box, own.black_box);
  EXPECT_EQ(info.varies_in_time, own.varies_in_time);
  EXPECT_NE(own.text_hash, 0u);
  const SurfacePoints points = test::random_points(2000, 7);
  const DirectionPairs pairs = test::random_pairs(2000, 8);
  const auto expected = library_->bind(points), found = user_->bind(points);
  Planes<3> a, b;
  expected->radiance_each(pairs, a), found->radiance_each(pairs, b);
  EXPECT_LE(part_that_differs(a, b, 1e-3f), .005);
  expected->transmittance(a), found->transmittance(b);
  EXPECT_LE(part_that_differs(a, b, 1e-4f), .005);
  expected->emission(a), found->emission(b);
  EXPECT_LE(part_that_differs(a, b, 1e-4f), .005);
  ASSERT_EQ(expected->shading_normals(a), found->shading_normals(b));
  if (library_->info().perturbs_normals) {
    EXPECT_LE(part_that_differs(a, b, 1e-3f), .005);
  }
  Materials m, n;
  ASSERT_EQ(expected->materials(m), found->materials(n));
  if (!library_->info().has_material) return;
  EXPECT_LE(part_that_differs(m.diffuse, n.diffuse, 1e-3f), .005);
  EXPECT_LE(part_that_differs(m.specular, n.specular, 1e-3f), .005);
  EXPECT_LE(part_that_differs(m.roughness, n.roughness, 1e-3f), .005);
  for (std::size_t i = 0; i < points.size(); ++i)
    ASSERT_NEAR(m.exponent[0][i] - n.exponent[0][i], 0, 1e-2f * m.exponent[0][i]) << i;
}

// One of each form: split, perturbing normals, black box.
class ThreeWays : public LibraryParity {};
INSTANTIATE_TEST_SUITE_P(Library, ThreeWays, testing::Values("noise", "brick", "toon_black_box"),
                         [](const auto& test) { return test.param; });

TEST_P(ThreeWays, ToAskForRadiance_AgreeBitForBit) {
  constexpr std::size_t kCount = 37;
  const auto bound = user_->bind(test::random_points(kCount, 5));
  const DirectionPairs pairs = test::random_pairs(kCount, 6);
  Planes<3> each, one;
  LaneVector<float> all;
  bound->radiance_each(pairs, each);
  bound->radiance_all(pairs, all);
  for (std::size_t i = 0; i < kCount; i += 9) {
    bound->radiance_one(i, pairs, one);
    for (int c = 0; c < 3; ++c) {
      EXPECT_EQ(one[c][i], each[c][i]);
      EXPECT_EQ(all[(i * 3 + c) * padded(kCount) + i], each[c][i]);
    }
  }
}

}  // namespace
}  // namespace redmap
