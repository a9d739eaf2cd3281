// Maps of meshes from near to far: the atlas, the clusters, and what is between them, against averages over the
// surface.
#include "atlas/far_error.h"

#include <gtest/gtest.h>

#include "surface/atlas.h"
#include "surface/shapes.h"

namespace redmap {
namespace {

TEST(FarError, SolidNoiseIsWithinAFewPercentOfAreaAverages_OnEveryLevel_AndBesideSeams) {
  TriangleMesh mesh = torus(64, 32, 1, 0.4f);
  TriangleMesh recut = mesh;
  unwrap(mesh, {.resolution = 512});
  unwrap(recut, {.charts = 60, .resolution = 512});
  const bench::FarError far =
      bench::measure_far_error(*make_mesh_surface(std::move(mesh)), *make_mesh_surface(std::move(recut)), 512);
  for (std::size_t i = 0; i < far.by_level.size(); ++i) EXPECT_LT(far.by_level[i], 0.05) << "level " << i + 1;
  // What a seam adds. Left as they are, lookups beside seams are three to five times less exact.
  EXPECT_LT(far.seam_over_recut, 1.2);
  EXPECT_LT(far.near_seam_over_recut, 2);
}

}  // namespace
}  // namespace redmap
