// Deviations from planted distributions of normals.
#include "map/normal_moments.h"

#include <gtest/gtest.h>

namespace redmap {
namespace {

TEST(NormalMoments, DeviationsFromAPlantedGaussian_AreThoseOfItsAxes) {
  const Vec3 mean{0.3f, 0.1f, 0.9f}, variance{0.04f, 0.01f, 0.0025f};
  const float moments[NormalMoments::kCount] = {mean.x,
                                                mean.y,
                                                mean.z,
                                                variance.x + mean.x * mean.x,
                                                mean.x * mean.y,
                                                mean.x * mean.z,
                                                variance.y + mean.y * mean.y,
                                                mean.y * mean.z,
                                                variance.z + mean.z * mean.z};
  EXPECT_NEAR(squared_deviations(moments, mean), 0, 1e-4);
  EXPECT_NEAR(squared_deviations(moments, mean + Vec3{0.5f, 0, 0}), 6.25, 0.01);
  EXPECT_NEAR(squared_deviations(moments, mean + Vec3{0, 0.25f, 0}), 6.25, 0.01);
  EXPECT_NEAR(squared_deviations(moments, mean + Vec3{0.2f, -0.1f, 0.05f}), 3, 0.01);
}

TEST(NormalMoments, OfOneNormal_HoldThatDirectionAlone) {
  const Vec3 normal = normalized({0.2f, -0.5f, 0.7f});
  float moments[NormalMoments::kCount];
  normal_moments(normal, moments);
  EXPECT_LT(squared_deviations(moments, normal), 0.1f);
  EXPECT_GT(squared_deviations(moments, normalized(normal + Vec3{0.01f, 0, 0})), 6.25f);
}

}  // namespace
}  // namespace redmap
