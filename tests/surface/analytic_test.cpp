// Sphere and cylinder against what is known of them.
#include <gtest/gtest.h>

#include "base/error.h"
#include "base/random.h"
#include "surface/surface.h"

namespace redmap {
namespace {

struct Case {
  const char* name;
  std::shared_ptr<const Surface> surface;
};

std::vector<Case> cases() { return {{"sphere", make_sphere(1.5f)}, {"cylinder", make_cylinder(0.7f, 3)}}; }

SurfaceHit complete_one(const Surface& surface, Vec2 uv) {
  const HitCoordinates where{0, uv};
  SurfaceHit hit;
  surface.complete({&where, 1}, {&hit, 1});
  return hit;
}

TEST(AnalyticSurface, AreasAndExtentsAreThoseOfGeometry) {
  EXPECT_NEAR(make_sphere(2)->area(), 16 * double(kPi), 1e-5);
  EXPECT_NEAR(make_cylinder(2, 3)->area(), 12 * double(kPi), 1e-5);
  EXPECT_EQ(make_sphere(2)->map_extent(64), (Extent{128, 64}));
  EXPECT_EQ(make_cylinder(2, 3)->map_extent(64), (Extent{64, 64}));
}

TEST(AnalyticSurface, NamedPlacesOfTheSphereHaveTheirUv) {
  const auto sphere = make_sphere(1);
  const auto uv_from = [&](Vec3 origin) { return sphere->intersect(origin, -origin, 0, 10)->where.coordinates; };
  EXPECT_NEAR(uv_from({2, 0, 0}).x, 0, 1e-7f);
  EXPECT_NEAR(uv_from({2, 0, 0}).y, 0.5f, 1e-7f);
  EXPECT_NEAR(uv_from({0, 0, 2}).x, 0.25f, 1e-7f);
  EXPECT_NEAR(uv_from({-2, 0, 0}).x, 0.5f, 1e-7f);
  EXPECT_NEAR(uv_from({0, 0, -2}).x, 0.75f, 1e-7f);
  EXPECT_NEAR(uv_from({0, 2, 0}).y, 0, 1e-7f);
  EXPECT_NEAR(uv_from({0, -2, 0}).y, 1, 1e-7f);
}

TEST(AnalyticSurface, ARasterisedPointIsHitAtItsPlace_AndGivesItsUvBack) {
  for (const auto& [name, surface] : cases()) {
    const Vec2 offsets[] = {{0.1f, 0.2f}, {0.8f, 0.6f}};
    const Extent extent = surface->map_extent(16);
    TexelPoints out;
    surface->rasterize(extent, {0, 0, extent.width, extent.height}, offsets, {}, out);
    ASSERT_EQ(out.texel.size(), std::size_t(2 * extent.width * extent.height)) << name;
    for (std::size_t i = 0; i < out.texel.size(); ++i) {
      const Vec3 p = out.points.position.get(i), n = out.points.normal.get(i);
      const auto hit = surface->intersect(p + n, -n, 0, 1.5f);
      ASSERT_TRUE(hit) << name;
      EXPECT_NEAR(hit->t, 1, 1e-5f);
      EXPECT_LT(length(hit->geometric_normal - n), 1e-5f);
      EXPECT_NEAR(hit->where.coordinates.x, out.points.uv[0][i], 1e-6f) << name;
      EXPECT_NEAR(hit->where.coordinates.y, out.points.uv[1][i], 1e-6f) << name;
      const SurfaceHit at = complete_one(*surface, hit->where.coordinates);
      EXPECT_LT(length(at.position - p), 2e-6f * 3);
      EXPECT_LT(length(at.tangent - out.points.tangent.get(i)), 1e-5f);
    }
  }
}

TEST(AnalyticSurface, ChangesWithUvAreThoseOfFiniteDifferences) {
  for (const auto& [name, surface] : cases()) {
    Random random(3);
    for (int trial = 0; trial < 100; ++trial) {
      const Vec2 uv{0.01f + 0.98f * random.next_float(), 0.01f + 0.98f * random.next_float()};
      const float step = 1e-3f;
      const SurfaceHit at = complete_one(*surface, uv);
      const auto difference = [&](Vec2 d, Vec3 SurfaceHit::*field) {
        return (complete_one(*surface, uv + d).*field - complete_one(*surface, uv - d).*field) / (2 * step);
      };
      EXPECT_LT(length(difference({step, 0}, &SurfaceHit::position) - at.dp_du), 2e-3f) << name;
      EXPECT_LT(length(difference({0, step}, &SurfaceHit::position) - at.dp_dv), 2e-3f) << name;
      EXPECT_LT(length(difference({step, 0}, &SurfaceHit::normal) - at.dn_du), 2e-3f) << name;
      EXPECT_LT(length(difference({0, step}, &SurfaceHit::normal) - at.dn_dv), 2e-3f) << name;
    }
  }
}

TEST(AnalyticSurface, PolesAreFinite_WithUnitTangents) {
  const auto sphere = make_sphere(1);
  for (const float v : {0.0f, 1.0f}) {
    const SurfaceHit pole = complete_one(*sphere, {0.3f, v});
    EXPECT_NEAR(length(pole.tangent), 1, 1e-6f);
    EXPECT_NEAR(dot(pole.tangent, pole.normal), 0, 1e-6f);
    EXPECT_TRUE(std::isfinite(length(pole.dp_du)));
    EXPECT_NEAR(length(pole.dp_dv), kPi, 1e-5f);
  }
}

TEST(AnalyticSurface, FarAwayOriginsDoNotBlurHits) {
  // From a million radii away, float t alone would place the hit only to within .06 of the radius.
  const auto sphere = make_sphere(1);
  const Vec3 direction = normalized({-1, -0.3f, 0.2f});
  const Vec3 target{0.3f, 0.5f, -0.4f};
  const double far_away = 0x1p20;
  const Vec3 origin{static_cast<float>(target.x - far_away * direction.x),
                    static_cast<float>(target.y - far_away * direction.y),
                    static_cast<float>(target.z - far_away * direction.z)};
  const auto far = sphere->intersect(origin, direction, 0, 1e9f);
  ASSERT_TRUE(far);
  // Rounding the origin itself moves the ray by up to 2^-4; the hit must still lie on the sphere to the last bits.
  const SurfaceHit at = complete_one(*sphere, far->where.coordinates);
  EXPECT_LT(length(at.normal - far->geometric_normal), 1e-6f);
  EXPECT_NEAR(length(far->geometric_normal), 1, 1e-6f);
}

TEST(AnalyticSurface, RaysFromInsideHitTheFarSide_WithTheNormalStillOutward) {
  for (const auto& [name, surface] : cases()) {
    const auto hit = surface->intersect({0, 0, 0}, {2, 0, 0}, 0, 100);
    ASSERT_TRUE(hit) << name;
    EXPECT_NEAR(hit->t * 2, surface->upper().x, 1e-6f);
    EXPECT_GT(hit->geometric_normal.x, 0.99f);
  }
}

TEST(AnalyticSurface, RaysMissWhereThereIsNothing) {
  EXPECT_FALSE(make_sphere(1)->intersect({0, 2, -5}, {0, 0, 1}, 0, 100));
  EXPECT_FALSE(make_sphere(1)->intersect({0, 0, -5}, {0, 0, 1}, 0, 3.9f));
  EXPECT_FALSE(make_sphere(1)->intersect({0, 0, -5}, {0, 0, 1}, 6.1f, 100));
  EXPECT_FALSE(make_cylinder(1, 2)->intersect({0, 0, 0}, {0, 1, 0}, 0, 100)) << "its ends are open";
  EXPECT_FALSE(make_cylinder(1, 2)->intersect({-5, 1.1f, 0}, {1, 0, 0}, 0, 100));
}

TEST(AnalyticSurface, UStaysBelowOne) {
  const auto sphere = make_sphere(1);
  const auto hit = sphere->intersect({3, 0, -1e-20f}, {-1, 0, 0}, 0, 10);
  ASSERT_TRUE(hit);
  EXPECT_LT(hit->where.coordinates.x, 1);
}

TEST(AnalyticSurface, SizesThatAreNotPositiveAreRefused) {
  EXPECT_THROW(make_sphere(0), Error);
  EXPECT_THROW(make_sphere(NAN), Error);
  EXPECT_THROW(make_cylinder(1, -1), Error);
}

}  // namespace
}  // namespace redmap
