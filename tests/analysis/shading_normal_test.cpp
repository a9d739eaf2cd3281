// Shading normals of black boxes: 24 reflectance models about known normals, each method where it holds and where it
// fails, and the library's shaders.
#include "analysis/shading_normal.h"

#include <gtest/gtest.h>

#include <cmath>

#include "shader/shader.h"
#include "shading_normals/shading_normals.h"

namespace redmap {
namespace {

using bench::kWrongNormal;
using bench::measure_shading_normals;
using bench::reflectance_model;
using bench::ReflectanceModel;
using bench::ShadingNormalsOptions;
using bench::ShadingNormalsRow;

constexpr int kNormals = 200;

class EveryModel : public testing::TestWithParam<ReflectanceModel> {};
INSTANTIATE_TEST_SUITE_P(Reflectance, EveryModel,
                         testing::ValuesIn(bench::reflectance_models().begin(), bench::reflectance_models().end()),
                         [](const auto& model) { return std::string(model.param.name); });

TEST_P(EveryModel, Cascade_NeverReportsAWrongNormal) {
  for (const double tilt_degrees : {0.0, 5.0, 40.0, 75.0})
    for (const bool single_precision : {false, true}) {
      const ShadingNormalsRow row =
          measure_shading_normals(GetParam(), NormalMethod::kCascade, {kNormals, tilt_degrees, single_precision});
      EXPECT_EQ(row.wrong_reported_as_found, 0) << tilt_degrees << " degrees, single precision " << single_precision;
    }
}

std::vector<bench::ReflectanceModel> smooth_models() {
  std::vector<bench::ReflectanceModel> smooth;
  for (const auto& model : bench::reflectance_models())
    if (model.smooth) smooth.push_back(model);
  return smooth;
}

class SmoothModel : public testing::TestWithParam<ReflectanceModel> {};
INSTANTIATE_TEST_SUITE_P(Reflectance, SmoothModel, testing::ValuesIn(smooth_models()),
                         [](const auto& model) { return std::string(model.param.name); });

TEST_P(SmoothModel, Cascade_FindsIt_InFortyCalls_AsFarAsPrecisionAllows) {
  const ShadingNormalsRow exact = measure_shading_normals(GetParam(), NormalMethod::kCascade, {kNormals, 40, false});
  EXPECT_EQ(exact.found, kNormals);
  EXPECT_LE(exact.calls, 40);
  EXPECT_LE(exact.p95_radians, 1e-10);
  const ShadingNormalsRow floats = measure_shading_normals(GetParam(), NormalMethod::kCascade, {kNormals, 40, true});
  EXPECT_EQ(floats.found, kNormals);
  EXPECT_LE(floats.calls, 40);
  EXPECT_LE(floats.p95_radians, 1e-4);
}

TEST(Cascade, FindsStepsNarrowLobesAndAnisotropy) {
  for (const char* name :
       {"phong500", "toon", "toon_on_black", "toon_three_bands", "ward_anisotropic", "ggx_anisotropic"}) {
    const ShadingNormalsRow row =
        measure_shading_normals(reflectance_model(name), NormalMethod::kCascade, {kNormals, 40, false});
    EXPECT_EQ(row.found, kNormals) << name;
    EXPECT_LE(row.p95_radians, 1e-6) << name;
  }
}

TEST(Cascade, ReportsFailureOnBlack_AndAnswersTheGeometricNormal) {
  const AskRadiance black = [](std::span<const DirectionPair>, std::span<double> r) { std::ranges::fill(r, 0.0); };
  const NormalEstimate estimate = estimate_shading_normal(black, {0, 0.6, 0.8});
  EXPECT_FALSE(estimate.found);
  EXPECT_EQ(estimate.stage, NormalStage::kNone);
  EXPECT_EQ(estimate.normal, (Direction{0, 0.6, 0.8}));
}

TEST(Cascade, WhereCoatAndBaseHaveDifferentNormals_AnswersOneOfThem_OrNothing) {
  const double coat_normal[3] = {0, 0, 1};
  for (double tilt = 0.05; tilt < 0.8; tilt += 0.01) {
    const double base_normal[3] = {std::sin(tilt), 0, std::cos(tilt)};
    const auto cosine = [](const double* n, const Direction& d) {
      return std::max(0.0, n[0] * d[0] + n[1] * d[1] + n[2] * d[2]);
    };
    const AskRadiance ask = [&](std::span<const DirectionPair> pairs, std::span<double> radiance) {
      for (std::size_t i = 0; i < pairs.size(); ++i)
        radiance[i] =
            0.5 * cosine(base_normal, pairs[i].to_light) + 0.5 * std::pow(cosine(coat_normal, pairs[i].to_light), 3);
    };
    const NormalEstimate estimate = estimate_shading_normal(ask, {0, 0, 1});
    if (!estimate.found) continue;
    const double angle = std::atan2(estimate.normal[0], estimate.normal[2]);
    EXPECT_LE(std::min(std::abs(angle), std::abs(angle - tilt)), kWrongNormal) << tilt;
    EXPECT_LE(std::abs(estimate.normal[1]), kWrongNormal) << tilt;
  }
}

TEST(Cascade, IsTheSameForAnyBrightness) {
  for (const double brightness : {1e-6, 1e6}) {
    const AskRadiance ask = [&](std::span<const DirectionPair> pairs, std::span<double> radiance) {
      for (std::size_t i = 0; i < pairs.size(); ++i) {
        const double cosine =
            std::max(0.0, 0.36 * pairs[i].to_light[0] + 0.48 * pairs[i].to_light[1] + 0.8 * pairs[i].to_light[2]);
        radiance[i] = brightness * cosine * (1 + cosine);
      }
    };
    const NormalEstimate estimate = estimate_shading_normal(ask, {0, 0, 1});
    ASSERT_TRUE(estimate.found);
    EXPECT_NEAR(estimate.normal[0], 0.36, 1e-10);
    EXPECT_NEAR(estimate.normal[1], 0.48, 1e-10);
  }
}

ShadingNormalsRow measured(const char* model, NormalMethod method) {
  return measure_shading_normals(reflectance_model(model), method, {kNormals, 40, false});
}

TEST(GreatArc, HoldsWhereBlackBeginsAtTheHorizon_InThirtyCalls) {
  for (const char* model : {"lambert", "lambert_phong50", "lambert_phong500", "lambert_ggx", "ggx", "lambert_blinn60",
                            "velvet", "oren_nayar", "coated", "ward_anisotropic", "ggx_anisotropic"}) {
    const ShadingNormalsRow row = measured(model, NormalMethod::kGreatArc);
    EXPECT_EQ(row.calls, 30) << model;
    EXPECT_LE(row.p95_radians, 1e-4) << model;
  }
}

TEST(GreatArc, FailsUnnoticed_OnAmbientLight_OtherHorizons_AndLobesAlone) {
  for (const char* model :
       {"ambient_phong50", "emission_lambert", "half_lambert", "wrapped_lambert", "two_sided_lambert",
        "phong50_cut_at_geometry", "toon", "toon_on_black", "phong500", "black"})
    EXPECT_GT(measured(model, NormalMethod::kGreatArc).wrong_reported_as_found, kNormals / 2) << model;
}

TEST(Reciprocity, HoldsForReciprocalReflectances_InSixCalls) {
  for (const char* model :
       {"lambert", "lambert_ggx", "ggx", "lambert_blinn60", "two_sided_lambert", "oren_nayar", "ward_anisotropic"}) {
    const ShadingNormalsRow row = measured(model, NormalMethod::kReciprocity);
    EXPECT_EQ(row.calls, 6) << model;
    EXPECT_LE(row.p95_radians, 1e-12) << model;
  }
}

TEST(Reciprocity, FailsWhereLightAndViewerCannotBeExchanged) {
  for (const char* model : {"ambient_phong50", "emission_lambert", "half_lambert", "wrapped_lambert", "toon", "velvet"})
    EXPECT_GT(measured(model, NormalMethod::kReciprocity).median_radians, kWrongNormal) << model;
  EXPECT_EQ(measured("black", NormalMethod::kReciprocity).found, 0);
}

/// Places on the unit sphere.
SurfacePoints sphere_points(std::size_t count) {
  SurfacePoints points;
  points.resize(count);
  for (std::size_t i = 0; i < count; ++i) {
    const float z = 1 - 2 * (static_cast<float>(i) + 0.5f) / static_cast<float>(count), r = std::sqrt(1 - z * z);
    const float azimuth = 2.39996f * static_cast<float>(i);
    const Vec3 normal{r * std::cos(azimuth), r * std::sin(azimuth), z};
    points.position.set(i, normal), points.normal.set(i, normal);
    points.tangent.set(i, make_frame(normal, {0, 1, 0}).x);
  }
  return points;
}

TEST(BoundPatterns, OfEveryLibraryShader_HaveTheirFramesNormal_OrReportFailure) {
  for (const std::string& name : library_shader_names()) {
    const auto patterns = make_library_shader(name)->bind(sphere_points(48));
    const ShadingNormals normals = estimate_shading_normals(*patterns);
    ASSERT_EQ(normals.found.size(), 48u);
    std::size_t found = 0;
    for (std::size_t i = 0; i < 48; ++i) {
      const Vec3 n = normals.normal.get(i);
      EXPECT_LE(length(cross(n, {0, 0, 1})), kWrongNormal) << name << " place " << i;
      found += normals.found[i];
    }
    // Cartoons' ink and anisotropic metal are as bright at the horizon as inside it, which says nothing.
    if (name == "scratched_metal" || name == "brushed_metal") continue;
    EXPECT_GT(found, 24u) << name;
  }
}

}  // namespace
}  // namespace redmap
