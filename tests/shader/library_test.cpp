// Known answers and agreements of the library's shaders.
#include <gtest/gtest.h>

#include "base/error.h"
#include "shader/shader_text.h"
#include "shader_test_support.h"

namespace redmap {
namespace {

using test::random_pairs;
using test::random_points;
using test::random_upper;

TEST(White, IsLambert_CosineOverPi) {
  const auto bound = make_library_shader("white")->bind(random_points(100, 1));
  const DirectionPairs pairs = random_pairs(100, 2);
  Planes<3> out;
  bound->radiance_each(pairs, out);
  for (std::size_t i = 0; i < 100; ++i)
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(out[c][i], pairs.to_light[2][i] / kPi, 1e-7f);
}

class EveryShader : public testing::TestWithParam<std::string> {
 protected:
  std::shared_ptr<const Shader> shader_ = make_library_shader(GetParam());
};
INSTANTIATE_TEST_SUITE_P(Library, EveryShader, testing::ValuesIn(library_shader_names()),
                         [](const auto& name) { return name.param; });

TEST_P(EveryShader, SaysWhatItIs) {
  EXPECT_EQ(shader_->info().name, GetParam());
  EXPECT_FALSE(shader_->info().summary.empty());
  EXPECT_FALSE(shader_->info().parameters.empty());
  EXPECT_EQ(shader_->parameters().size(), shader_->info().parameters.size());
}

TEST_P(EveryShader, RadianceIsFiniteAndNotNegative) {
  const auto bound = shader_->bind(random_points(1000, 3));
  DirectionPairs pairs = random_pairs(36, 4);
  pairs.to_light.set(0, Vec3{0, 0, 1}), pairs.to_viewer.set(0, Vec3{0, 0, 1});
  pairs.to_light.set(1, Vec3{1, 0, 0}), pairs.to_viewer.set(1, Vec3{-1, 0, 0});
  pairs.to_light.set(2, Vec3{0, 0, -1}), pairs.to_viewer.set(2, Vec3{0, 0, 1});
  LaneVector<float> out;
  bound->radiance_all(pairs, out);
  float brightest = 0;
  for (std::size_t row = 0; row < 36 * 3; ++row)
    for (std::size_t i = 0; i < 1000; ++i) {
      const float value = out[row * padded(1000) + i];
      ASSERT_TRUE(std::isfinite(value) && value >= 0) << "row " << row << " point " << i << ": " << value;
      if (row >= 6 && row < 9) {
        ASSERT_EQ(value, 0) << "light below the horizon";
      }
      brightest = std::max(brightest, value);
    }
  EXPECT_GT(brightest, 0.05f);
}

TEST_P(EveryShader, EachOneAndAll_AgreeBitForBit) {
  constexpr std::size_t kCount = 43;
  const auto bound = shader_->bind(random_points(kCount, 5));
  const DirectionPairs pairs = random_pairs(kCount, 6);
  Planes<3> each, one;
  LaneVector<float> all;
  bound->radiance_each(pairs, each);
  bound->radiance_all(pairs, all);
  ASSERT_EQ(each.size(), kCount);
  ASSERT_EQ(all.size(), kCount * 3 * padded(kCount));
  for (std::size_t i = 0; i < kCount; ++i) {
    bound->radiance_one(i, pairs, one);
    for (int c = 0; c < 3; ++c) {
      EXPECT_EQ(one[c][i], each[c][i]);
      EXPECT_EQ(all[(i * 3 + static_cast<std::size_t>(c)) * padded(kCount) + i], each[c][i]);
    }
  }
}

TEST_P(EveryShader, IsIndependentOfLaneAndBatch) {
  constexpr std::size_t kCount = 37;
  const SurfacePoints points = random_points(kCount, 7);
  const DirectionPairs pairs = random_pairs(kCount, 8);
  Planes<3> together, alone;
  shader_->bind(points)->radiance_each(pairs, together);
  for (std::size_t i = 0; i < kCount; ++i) {
    shader_->bind(test::repeated(points, i, 1 + i % 11))->radiance_one(i % (1 + i % 11), pairs, alone);
    for (int c = 0; c < 3; ++c) EXPECT_EQ(alone[c][i], together[c][i]);
  }
}

TEST_P(EveryShader, TransmittanceAndMaterialsMatchTheDeclaration) {
  const auto bound = shader_->bind(random_points(500, 9));
  Planes<3> transmittance, emission;
  bound->transmittance(transmittance);
  bound->emission(emission);
  Materials materials;
  EXPECT_EQ(bound->materials(materials), shader_->info().has_material);
  float transmitted = 0, emitted = 0;
  for (std::size_t i = 0; i < 500; ++i)
    for (int c = 0; c < 3; ++c) {
      ASSERT_TRUE(transmittance[c][i] >= 0 && transmittance[c][i] <= 1);
      if (shader_->info().has_material) {
        EXPECT_EQ(materials.transmittance[c][i], transmittance[c][i]);
      }
      transmitted += transmittance[c][i], emitted += emission[c][i];
    }
  EXPECT_EQ(transmitted > 0, shader_->info().transmits);
  EXPECT_EQ(emitted > 0, shader_->info().emits);
}

TEST_P(EveryShader, TextIsCompleteAndDeclaresTheSame) {
  const std::string text = library_shader_text(GetParam());
  EXPECT_EQ(text.find("#include"), std::string::npos);
  EXPECT_NE(text.find("struct Surface"), std::string::npos);
  EXPECT_EQ(parse_shader_text(text, GetParam() + ".glsl").parameters.size(), shader_->info().parameters.size());
}

}  // namespace
}  // namespace redmap
