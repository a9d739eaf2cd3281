// A linear texture on a flat square whose halves lie apart in the map: under every footprint the mean is the value in
// its middle, whether or not a seam is under it.
#include "render/seam_lookup.h"

#include <gtest/gtest.h>

#include <cmath>

#include "render/hit_footprint.h"
#include "surface/mesh.h"

namespace redmap {
namespace {

constexpr int kSize = 128;

/// The unit square in the plane z = 0, cut along its diagonal; the second half is turned by 90 degrees.
std::shared_ptr<const Surface> cut_square() {
  TriangleMesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  mesh.uv = {{0.05f, 0.05f}, {0.45f, 0.05f}, {0.45f, 0.45f}, {0.95f, 0.55f}, {0.55f, 0.95f}, {0.55f, 0.55f}};
  mesh.uv_triangles = {{0, 1, 2}, {3, 4, 5}};
  return make_mesh_surface(std::move(mesh));
}

float texture(Vec3 p) { return 0.5f + 0.2f * (p.x - p.y) + 0.1f * p.x; }

WeightPyramid bake_texture(const Surface& surface) {
  BaseLevel base(surface.map_extent(kSize), 1, false);
  std::vector<Vec2> offsets;
  for (int i = 0; i < 16; ++i) offsets.push_back({(float(i % 4) + 0.5f) / 4, (float(i / 4) + 0.5f) / 4});
  TexelPoints found;
  surface.rasterize(base.extent, {0, 0, kSize, kSize}, offsets, {}, found);
  for (std::size_t i = 0; i < found.points.size(); ++i) {
    base.values[found.texel[i]] += texture(found.points.position.get(i));
    base.coverage[found.texel[i]] += 1;
  }
  for (std::size_t t = 0; t < base.coverage.size(); ++t)
    if (base.coverage[t] > 0) base.values[t] /= base.coverage[t], base.coverage[t] /= 16;
  return WeightPyramid(base);
}

/// The square's place (x, y), x >= y.
SurfaceHit hit_at(const Surface& surface, float x, float y) {
  const HitCoordinates where{0, {x - y, y}};
  SurfaceHit hit;
  surface.complete({&where, 1}, {&hit, 1});
  return hit;
}

TEST(SeamLookup, LinearTextureIsItsOwnMean_OverTheSeamToo) {
  const auto surface = cut_square();
  const WeightPyramid weights = bake_texture(*surface);
  const float texel = 1 / (0.4f * kSize);
  float worst_alone = 0;
  for (const float width : {2.0f, 4.0f, 8.0f})
    for (const float away : {0.0f, 0.01f, 0.03f}) {
      const SurfaceHit hit = hit_at(*surface, 0.5f + away, 0.5f - away);
      const Footprint footprint = round_footprint(hit, width * texel);
      const FilteredTexel alone = weights.lookup(footprint);
      std::uint64_t lookups = 0;
      const FilteredTexel whole = mend_at_seams(weights, *surface->seams(), hit.chart, footprint, alone, lookups);
      EXPECT_NEAR(whole.channel[0], texture(hit.position), 0.004f) << width << " texels, " << away << " from the seam";
      worst_alone = std::max(worst_alone, std::abs(alone.channel[0] - texture(hit.position)));
    }
  EXPECT_GT(worst_alone, 0.01f);
}

TEST(SeamLookup, AwayFromSeamsNothingIsLookedUpOrChanged) {
  const auto surface = cut_square();
  const WeightPyramid weights = bake_texture(*surface);
  const SurfaceHit hit = hit_at(*surface, 0.7f, 0.3f);
  const Footprint footprint = round_footprint(hit, 0.05f);
  const FilteredTexel alone = weights.lookup(footprint);
  std::uint64_t lookups = 0;
  EXPECT_EQ(mend_at_seams(weights, *surface->seams(), hit.chart, footprint, alone, lookups).channel, alone.channel);
  EXPECT_EQ(lookups, 0u);
}

}  // namespace
}  // namespace redmap
