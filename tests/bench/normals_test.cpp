// The bench of bumpy surfaces: its cases are what they say, its sums are right, and its rows are complete.
#include "normals/normals.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "bake/bake.h"
#include "base/error.h"
#include "normals/cases.h"
#include "normals/summary.h"
#include "quality/bench_scene.h"
#include "scene/placement.h"

namespace redmap::bench {
namespace {

NormalsRow row(const char* bump, double minification, const char* method, int spp, double rmse) {
  NormalsRow result;
  result.object = "plane", result.bump = bump, result.gloss = "ggx.1";
  result.minification = minification;
  result.method = method, result.spp = spp, result.relative_rmse = rmse;
  if (result.method == "map") result.quality = "default";
  result.shader_calls_per_lookup = 0.5;
  return result;
}

TEST(NormalsSummary, OfPlantedRows_HasTheirGeometricMeans_WinsAndWorst) {
  std::vector<NormalsRow> rows{row("caps", 4, "map", 0, 0.2),   row("caps", 4, "supersample", 64, 0.1),
                               row("caps", 8, "map", 0, 0.1),   row("caps", 8, "supersample", 64, 0.2),
                               row("brick", 8, "map", 0, 0.1),  row("brick", 8, "supersample", 64, 0.8),
                               row("brick", 8, "paper", 0, 0.4)};
  rows[4].shader_calls_per_lookup = 100;  // two bases: not counted
  NormalsRow fast = row("caps", 4, "map", 0, 99);
  fast.quality = "fast";
  rows.push_back(fast);
  const NormalsSummary summary = summarize(rows);
  EXPECT_NEAR(*summary.map_over_64spp_rmse, 0.5, 1e-9);  // (2 * 1/2 * 1/8)^(1/3)
  EXPECT_NEAR(*summary.map_over_paper_rmse, 0.25, 1e-9);
  EXPECT_NEAR(*summary.win_rate_against_64spp, 2.0 / 3, 1e-9);
  EXPECT_NEAR(*summary.worst_over_64spp, 2, 1e-9);
  EXPECT_EQ(summary.worst_case, "plane caps ggx.1 at 4");
  EXPECT_NEAR(*summary.calls_single_basis, 0.5, 1e-9);
  EXPECT_FALSE(summary.map_over_parameters_rmse || summary.map_over_64spp_flicker);
}

TEST(BumpyShader, HasOneBasisWhereItSaysSo) {
  const auto sphere = make_sphere(1);
  BakeOptions options;
  options.size = 128;
  for (const std::string& bump : bump_names()) {
    const char* gloss = go_together(bump, "phong100") ? "phong100" : "ward.1x.4";
    const auto shader = make_bumpy_shader(bump, gloss, texel_width(*sphere, 128), 0);
    EXPECT_EQ(bake(*sphere, *shader, options).basis.size(), is_single_basis(bump) ? 1u : 2u) << bump;
  }
  EXPECT_THROW(make_bumpy_shader("dents", "phong100", 0.01, 0), Error);
  EXPECT_THROW(make_bumpy_shader("caps", "matte", 0.01, 0), Error);
  EXPECT_THROW(make_bumpy_shader("grain", "phong100", 0.01, 0), Error);
}

TEST(BumpyShader, BeingBusyChangesNothing) {
  SurfacePoints points;
  points.resize(64);
  DirectionPairs pairs;
  pairs.resize(64);
  for (std::size_t i = 0; i < 64; ++i) {
    points.position.set(i, Vec3{0.1f * static_cast<float>(i), 0.3f, 0});
    points.normal.set(i, Vec3{0, 0, 1}), points.tangent.set(i, Vec3{1, 0, 0});
    pairs.to_light.set(i, Vec3{0.6f, 0, 0.8f}), pairs.to_viewer.set(i, Vec3{-0.6f, 0, 0.8f});
  }
  Planes<3> idle, busy;
  make_bumpy_shader("brick", "ggx.2", 0.01, 0)->bind(points)->radiance_each(pairs, idle);
  make_bumpy_shader("brick", "ggx.2", 0.01, 50)->bind(points)->radiance_each(pairs, busy);
  for (std::size_t i = 0; i < 64; ++i) EXPECT_EQ(idle.get(i), busy.get(i));
}

TEST(BumpyScene, ShowsThePlaneAtFortyDegrees_AtTheMinificationAskedFor) {
  const auto plane = make_bumpy_surface("plane", "");
  const auto shader = make_bumpy_shader("fbm.25", "ggx.1", texel_width(*plane, 256), 0);
  for (const double minification : {2.0, 4.0, 16.0})
    for (int view : {0, 3}) {
      const Scene scene = make_bumpy_scene("plane", plane, shader, 256, minification, view, 32);
      EXPECT_NEAR(median_minification(scene), minification, 0.05 * minification);
      EXPECT_LE(scene.camera.width, 32);
      const Vec3 normal = make_placement(scene.objects[0].transform).direction_world({0, 0, 1});
      EXPECT_NEAR(std::asin(normal.z) * 180 / kPi, 40, 0.01);
      // The highlight of the mean normal is near the middle.
      const Vec3 to_light = normalized(scene.lights[0].position - scene.objects[0].transform.translate);
      EXPECT_GT(dot(normalized(to_light + Vec3{0, 0, 1}), normal), 0.95f);
    }
}

TEST(MeasureNormals, HasARowForEveryMethod_AndMoreSamplesAreBetter) {
  NormalsOptions options;
  options.objects = {"plane"}, options.bumps = {"fbm.25"}, options.glosses = {"ggx.2"};
  options.minifications = {8};
  options.map_size = 128, options.reference_spp = 400, options.largest = 16, options.views = 2;
  options.flicker_frames = 2, options.repeats = 1;
  const auto rows = measure_normals(options);
  std::set<std::string> methods;
  for (const NormalsRow& row : rows) {
    methods.insert(row.method + row.quality + std::to_string(row.spp));
    EXPECT_TRUE(std::isfinite(row.relative_rmse) && row.relative_rmse > row.reference_residual) << row.method;
    EXPECT_GT(row.shader_calls_per_lookup, 0) << row.method;
    EXPECT_TRUE(row.flicker && row.flicker_slow && *row.flicker > 0 && *row.flicker_slow > 0) << row.method;
  }
  EXPECT_EQ(methods, (std::set<std::string>{"mapbalanced0", "mapdefault0", "mapfast0", "paper0", "parametersdefault0",
                                            "supersample16", "supersample64"}));
  EXPECT_NEAR(rows[0].shader_calls_per_lookup, 16, 2);
  EXPECT_GT(rows[0].relative_rmse, 1.3 * rows[1].relative_rmse);
}

}  // namespace
}  // namespace redmap::bench
