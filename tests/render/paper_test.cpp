// The paper's two methods for bumpy surfaces, and what was decided where.
#include <gtest/gtest.h>

#include "bake/bake.h"
#include "bake/baselines.h"
#include "render_test_support.h"

namespace redmap {
namespace {

struct PaperScene {
  Scene scene;
  std::vector<ObjectData> data;

  explicit PaperScene(const char* shader, int size)
      : scene(test::sphere_scene(make_library_shader(shader), {1, 1, 1})) {
    const Object& ball = scene.objects[0];
    BakeOptions baking;
    baking.size = size;
    data = {{std::make_shared<const ReductionMap>(bake(*ball.surface, *ball.shader, baking)), nullptr,
             std::make_shared<const Pyramid<float>>(build_normal_pyramid(*ball.surface, *ball.shader, size))}};
  }
  RenderedFrame render(Method method) const {
    RenderOptions options;
    options.method = method;
    options.decisions = true;
    return Renderer(scene, options, data).render(scene, 1);
  }
};

TEST(PaperRule, PixelsThatMaySeeAHighlight_AreSixteenSamplesOfTheShader_BitForBit) {
  const PaperScene paper("hammered_metal", 256);
  const RenderedFrame found = paper.render(Method::kPaper), samples = paper.render(Method::kSupersample);
  std::size_t supersampled = 0, by_mean = 0;
  for (std::size_t i = 0; i < found.decisions.size(); ++i) {
    by_mean += found.decisions[i] == Decision::kMeanNormal;
    if (found.decisions[i] != Decision::kSupersampled) continue;
    ++supersampled;
    for (std::size_t c = 0; c < 3; ++c) ASSERT_EQ(found.image.data[3 * i + c], samples.image.data[3 * i + c]);
  }
  EXPECT_EQ(found.counts.supersampled_pixels, supersampled);
  EXPECT_GT(supersampled, 50u);
  EXPECT_GT(by_mean, 100u);
  // Every shader call is one of these 16, one at a mean normal, or one of a pixel subdivided at the silhouette.
  EXPECT_GE(found.counts.shader_calls, 16 * supersampled + by_mean);
}

TEST(PaperRule, FollowsTheHalfVector_NotTheBrightness) {
  // Away from light and viewer's half vector no normal of these bumps mirrors one into the other.
  const PaperScene paper("hammered_metal", 256);
  const RenderedFrame found = paper.render(Method::kPaper);
  const Vec3 half_vector = normalized(normalized(Vec3{1, 1, 1}) + Vec3{0, 0, 1});
  const auto decision_at = [&](Vec3 normal) {
    // Where the sphere has that normal, seen from (0, 0, 5).
    const float scale = 0.5f * 64 / (5 - normal.z) / std::tan(20 * kPi / 180);
    const int x = static_cast<int>(32 + scale * normal.x), y = static_cast<int>(32 - scale * normal.y);
    return found.decisions[static_cast<std::size_t>(y) * 64 + x];
  };
  EXPECT_EQ(decision_at(half_vector), Decision::kSupersampled);
  EXPECT_EQ(decision_at(normalized({-half_vector.x, -half_vector.y, half_vector.z})), Decision::kMeanNormal);
}

TEST(PaperRule, HoldsForShadersThatPerturbNormalsAlone) {
  const PaperScene smooth("checker", 256);
  const RenderedFrame found = smooth.render(Method::kPaper);
  EXPECT_EQ(found.counts.supersampled_pixels, 0u);
  EXPECT_EQ(std::count(found.decisions.begin(), found.decisions.end(), Decision::kSupersampled), 0);
}

TEST(Decisions, OfTheMap_ConvolveTheHighlightsOfBumps_AndNothingOfPlainWhite) {
  const PaperScene bumps("hammered_metal", 256);
  const RenderedFrame convolved = bumps.render(Method::kMap);
  EXPECT_GT(std::count(convolved.decisions.begin(), convolved.decisions.end(), Decision::kConvolved), 300);
  EXPECT_EQ(std::count(convolved.decisions.begin(), convolved.decisions.end(), Decision::kDrawn), 0);
  const PaperScene smooth("white", 256);
  const RenderedFrame plain = smooth.render(Method::kMap);
  EXPECT_GT(std::count(plain.decisions.begin(), plain.decisions.end(), Decision::kMeanNormal), 300);
  EXPECT_EQ(std::count(plain.decisions.begin(), plain.decisions.end(), Decision::kConvolved), 0);
}

TEST(Decisions, CloseUpAreTheOriginal_AndPaintedInColoursOfTheirOwn) {
  const PaperScene coarse("checker", 4);
  const RenderedFrame found = coarse.render(Method::kMap);
  EXPECT_GT(std::count(found.decisions.begin(), found.decisions.end(), Decision::kOriginal), 500);
  EXPECT_GT(std::count(found.decisions.begin(), found.decisions.end(), Decision::kBackground), 500);
  EXPECT_GT(std::count(found.decisions.begin(), found.decisions.end(), Decision::kSubdivided), 20);
  const Image image = paint_decisions(found.decisions, 64, 64);
  for (int y = 0; y < 64; ++y)
    for (int x = 0; x < 64; ++x)
      EXPECT_EQ(image.rgb(x, y), decision_legend(found.decisions[static_cast<std::size_t>(y) * 64 + x]).color);
  for (int a = 0; a < kDecisionCount; ++a)
    for (int b = 0; b < a; ++b)
      EXPECT_FALSE(decision_legend(static_cast<Decision>(a)).color == decision_legend(static_cast<Decision>(b)).color);
}

}  // namespace
}  // namespace redmap
