// GGX and Blinn's lobe against what is known of them analytically, and against each other.
#include <gtest/gtest.h>

#include "shader_test_support.h"

// Last, since it gives GLSL's type names their meaning; plain numbers are `real` from here on.
using real = float;
#include "shader/glsl.h"
namespace redmap::text {
namespace {
using namespace redmap::glsl;
#include "shader/library/include/blinn.glsl"
#include "shader/library/include/ggx.glsl"
}  // namespace
}  // namespace redmap::text

namespace redmap {
namespace {

using glsl::Float;

glsl::Vec3 everywhere(Vec3 v) { return {Float(v.x), Float(v.y), Float(v.z)}; }
const glsl::Vec3 kWhite(Float(1.0f));

/// Integral of lobe(to_viewer) times the viewer's cosine over the hemisphere, by the midpoint rule.
template <typename Lobe>
double albedo(const Lobe& lobe) {
  constexpr auto kSteps = 1500, kAzimuths = 64;
  double sum = 0;
  for (auto i = 0; i < kSteps; ++i)
    for (auto j = 0; j < kAzimuths; ++j) {
      // Equal steps of the angle rather than of its cosine: lobes are narrow around the normal.
      const double polar = (i + 0.5) / kSteps * static_cast<double>(kPi) / 2;
      const double azimuth = 2 * static_cast<double>(kPi) * (j + 0.5) / kAzimuths;
      const Vec3 viewer{static_cast<real>(std::sin(polar) * std::cos(azimuth)),
                        static_cast<real>(std::sin(polar) * std::sin(azimuth)), static_cast<real>(std::cos(polar))};
      sum += static_cast<double>(lobe(everywhere(viewer))) * std::cos(polar) * std::sin(polar);
    }
  return sum * static_cast<double>(kPi) * static_cast<double>(kPi) / (kSteps * kAzimuths);
}

TEST(Ggx, MirrorsAWhiteFurnace_NearlyAllWhereSmooth_AndNeverMoreThanAll) {
  const glsl::Vec3 light = everywhere({0, 0, 1});
  const auto ggx = [&](real x, real y) {
    return albedo([&](glsl::Vec3 viewer) {
      return text::ggx_anisotropic_lobe(kWhite, {Float(x), Float(y)}, light, viewer).x.v[0];
    });
  };
  // What is missing bounced between facets more than once, which the model leaves out.
  double before = 1;
  for (const real alpha : {0.05f, 0.1f, 0.2f, 0.4f, 0.8f}) {
    const double now = ggx(alpha, alpha);
    EXPECT_LT(now, before) << alpha;
    before = now;
  }
  EXPECT_GT(ggx(0.05f, 0.05f), 0.99);
  EXPECT_GT(ggx(0.05f, 0.2f), 0.97);
  EXPECT_LT(ggx(0.05f, 0.2f), 1);
}

TEST(Ggx, PeaksAtOneOverFourPiAlphaAlpha) {
  const glsl::Vec3 up = everywhere({0, 0, 1});
  EXPECT_NEAR(text::ggx_lobe(kWhite, Float(0.3f), up, up).x.v[0], 1 / (4 * kPi * 0.09f), 1e-4f);
  EXPECT_NEAR(text::ggx_anisotropic_lobe(kWhite, {Float(0.1f), Float(0.4f)}, up, up).x.v[0], 1 / (4 * kPi * 0.04f),
              1e-4f);
}

TEST(Ggx, AnisotropicWithEqualRoughness_IsTheIsotropic) {
  Random random(1);
  for (auto i = 0; i < 1000; ++i) {
    const glsl::Vec3 light = everywhere(test::random_upper(random)), viewer = everywhere(test::random_upper(random));
    const Float alpha(0.05f + 0.9f * random.next_float());
    const real expected = text::ggx_lobe(everywhere({0.2f, 0.5f, 0.9f}), alpha, light, viewer).y.v[0];
    const real found = text::ggx_anisotropic_lobe(everywhere({0.2f, 0.5f, 0.9f}), {alpha, alpha}, light, viewer).y.v[0];
    EXPECT_NEAR(found, expected, 2e-3f * (1e-3f + expected));
  }
}

TEST(Ggx, IsBrighterAcrossTheRougherDirection_AndSwapsWithIt) {
  const glsl::Vec3 light = everywhere({0, 0, 1});
  const glsl::Vec3 along = everywhere({0.6f, 0, 0.8f}), across = everywhere({0, 0.6f, 0.8f});
  const glsl::Vec2 alpha{Float(0.1f), Float(0.4f)}, swapped{Float(0.4f), Float(0.1f)};
  const real a = text::ggx_anisotropic_lobe(kWhite, alpha, light, along).x.v[0];
  const real b = text::ggx_anisotropic_lobe(kWhite, alpha, light, across).x.v[0];
  EXPECT_GT(b, 3 * a);
  EXPECT_NEAR(text::ggx_anisotropic_lobe(kWhite, swapped, light, along).x.v[0], b, 1e-5f * b);
}

TEST(Blinn, FromAbove_ReflectsTwiceTheRatioOfItsNormalisationsLessOne) {
  // 2 (e + 2) / (e + 4) - 1: the integral over the half vector of the lobe with the viewer's cosine.
  for (const real exponent : {50.0f, 200.0f, 800.0f}) {
    const double found = albedo([&](glsl::Vec3 viewer) {
      return text::blinn_lobe(Float(exponent), everywhere({0, 0, 1}), viewer).v[0];
    });
    EXPECT_NEAR(found, 2 * (exponent + 2) / (exponent + 4) - 1, 1e-3) << exponent;
  }
}

}  // namespace
}  // namespace redmap
