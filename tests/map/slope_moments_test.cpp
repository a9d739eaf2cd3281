// Moments of slopes against planted distributions of normals.
#include "map/slope_moments.h"

#include <gtest/gtest.h>

#include "base/random.h"

namespace redmap {
namespace {

struct Moments {
  float sum[SlopeMoments::kCount] = {};
  void add(Vec3 normal, float part) {
    float one[SlopeMoments::kCount];
    slope_moments(normal, one);
    for (int c = 0; c < SlopeMoments::kCount; ++c) sum[c] += part * one[c];
  }
};

TEST(SlopeMoments, OfOneNormal_AreThatNormal_WithoutVariance) {
  const Vec3 normal = normalized({0.3f, -0.2f, 0.8f});
  Moments moments;
  moments.add(normal, 1);
  const NormalsOfSlopes found = normals_of_slopes(moments.sum);
  EXPECT_LT(length(found.mean - normal), 1e-6f);
  EXPECT_NEAR(found.covariance.xx, 0, 1e-6f);
  EXPECT_NEAR(found.covariance.xy, 0, 1e-6f);
  EXPECT_NEAR(found.covariance.yy, 0, 1e-6f);
}

TEST(SlopeMoments, OfTwoSlopes_HaveTheirVarianceAlongTheirDifference) {
  Moments moments;
  for (const float side : {-1.0f, 1.0f}) moments.add(normalized({0.3f * side, 0.4f * side, 1}), 0.5f);
  const NormalsOfSlopes found = normals_of_slopes(moments.sum);
  EXPECT_LT(length(found.mean - Vec3{0, 0, 1}), 1e-6f);
  EXPECT_NEAR(found.covariance.xx, 0.09f, 1e-6f);
  EXPECT_NEAR(found.covariance.xy, 0.12f, 1e-6f);
  EXPECT_NEAR(found.covariance.yy, 0.16f, 1e-6f);
}

TEST(SlopeMoments, CovarianceOfNormals_IsThatAboutALeaningMean) {
  // Slopes about a steep mean: the normals' own covariance in the mean's frame, counted directly.
  const Vec2 mean{0.6f, -0.3f};
  const Frame frame = make_frame(normalized({mean.x, mean.y, 1}), {1, 0, 0});
  Random random(3);
  Moments moments;
  Covariance2 expected;
  constexpr int kCount = 100000;
  for (int i = 0; i < kCount; ++i) {
    const float a = 0.1f * (random.next_float() - 0.5f), b = 0.04f * (random.next_float() - 0.5f);
    const Vec3 normal = normalized({mean.x + a, mean.y + b + 0.5f * a, 1});
    moments.add(normal, 1.0f / kCount);
    const Vec3 local = frame.to_local(normal);
    expected.xx += local.x * local.x / kCount, expected.xy += local.x * local.y / kCount;
    expected.yy += local.y * local.y / kCount;
  }
  const Covariance2 found = covariance_in_frame(normals_of_slopes(moments.sum), frame);
  EXPECT_NEAR(found.xx, expected.xx, 0.02f * expected.xx);
  EXPECT_NEAR(found.xy, expected.xy, 0.02f * expected.xx);
  EXPECT_NEAR(found.yy, expected.yy, 0.02f * expected.xx);
}

TEST(SlopeMoments, StayFinite_AtTheHorizonAndBelow) {
  Moments moments;
  moments.add({1, 0, 0}, 0.5f), moments.add({0, 0.6f, -0.8f}, 0.5f);
  const NormalsOfSlopes found = normals_of_slopes(moments.sum);
  EXPECT_NEAR(length(found.mean), 1, 1e-6f);
  EXPECT_TRUE(std::isfinite(found.covariance.xx) && std::isfinite(found.covariance.yy));
}

}  // namespace
}  // namespace redmap
