// Maps of meshes from near to far: the atlas, the clusters, and what is between them, against averages over the
// surface.
#include "atlas/far_error.h"

#include <gtest/gtest.h>

#include "surface/atlas.h"
#include "surface/shapes.h"

namespace redmap {
namespace {

TEST(FarError, SolidNoiseIsWithinAFewPercentOfAreaAverages_OnEveryLevel) {
  TriangleMesh mesh = torus(64, 32, 1, 0.4f);
  unwrap(mesh, {.resolution = 512});
  const bench::FarError far = bench::measure_far_error(*make_mesh_surface(std::move(mesh)), 512);
  for (std::size_t i = 0; i < far.by_level.size(); ++i) EXPECT_LT(far.by_level[i], 0.05) << "level " << i + 1;
}

}  // namespace
}  // namespace redmap
