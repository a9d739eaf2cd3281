// Meshes as surfaces: the square, where everything is known, and a bent sheet against finite differences.
#include <gtest/gtest.h>

#include "base/error.h"
#include "base/random.h"
#include "shapes.h"
#include "surface/surface.h"

namespace redmap {
namespace {

constexpr Vec2 kCentre[] = {{0.5f, 0.5f}};

/// The square, bent to a quarter of a cylinder of radius 1 about the y axis: u becomes the arc, v the height.
TriangleMesh bent_square(std::uint32_t n) {
  TriangleMesh mesh = square(n);
  for (Vec3& p : mesh.positions) p = {std::sin(p.x), p.y, std::cos(p.x)};
  return mesh;
}

TEST(MeshSurface, SquareHasItsAnalyticAreas) {
  const auto surface = make_mesh_surface(square(7));
  EXPECT_NEAR(surface->area(), 1, 1e-6);
  EXPECT_NEAR(surface->uv_area(), 1, 1e-6);
  EXPECT_EQ(surface->upper(), (Vec3{1, 1, 0}));
  EXPECT_FALSE(surface->wraps_u());
}

TEST(MeshSurface, EveryTexelOfASquareIsFoundOnce_AtItsPlace_EvenOnSharedEdges) {
  // With 8 cells and 32 texels, corners of texels lie exactly on edges and diagonals.
  const auto surface = make_mesh_surface(square(8));
  const Vec2 corner_and_centre[] = {{0, 0}, {0.5f, 0.5f}};
  TexelPoints out;
  surface->rasterize({32, 32}, {0, 0, 32, 32}, corner_and_centre, {}, out);
  ASSERT_EQ(out.texel.size(), 2 * 32 * 32u);
  for (std::size_t i = 0; i < out.texel.size(); ++i) {
    ASSERT_EQ(out.texel[i], i / 2);
    const Vec2 expected{(float(out.texel[i] % 32) + corner_and_centre[i % 2].x) / 32,
                        (float(out.texel[i] / 32) + corner_and_centre[i % 2].y) / 32};
    const Vec3 p = out.points.position.get(i);
    EXPECT_NEAR(p.x, expected.x, 1e-6f);
    EXPECT_NEAR(p.y, expected.y, 1e-6f);
    EXPECT_NEAR(out.points.normal.get(i).z, 1, 1e-6f);
    EXPECT_NEAR(out.points.tangent.get(i).x, 1, 1e-6f);
  }
}

TEST(MeshSurface, TilesGiveWhatTheWholeGives) {
  const auto surface = make_mesh_surface(bent_square(13));
  TexelPoints whole, tile;
  surface->rasterize({50, 50}, {0, 0, 50, 50}, kCentre, {}, whole);
  ASSERT_EQ(whole.texel.size(), 2500u);
  for (int y = 0; y < 50; y += 10)
    for (int x = 0; x < 50; x += 25) {
      surface->rasterize({50, 50}, {x, y, 25, 10}, kCentre, {}, tile);
      ASSERT_EQ(tile.texel.size(), 250u);
      for (std::size_t i = 0; i < tile.texel.size(); ++i) {
        const std::size_t in_whole = (y + tile.texel[i] / 25) * 50 + x + tile.texel[i] % 25;
        EXPECT_EQ(tile.points.position.get(i), whole.points.position.get(in_whole));
        EXPECT_EQ(tile.points.normal.get(i), whole.points.normal.get(in_whole));
      }
    }
}

TEST(MeshSurface, OnlyWantedTexelsAreFound) {
  const auto surface = make_mesh_surface(square(2));
  std::vector<std::uint8_t> wanted(16, 0);
  wanted[3] = wanted[9] = 1;
  TexelPoints out;
  surface->rasterize({4, 4}, {0, 0, 4, 4}, kCentre, wanted, out);
  EXPECT_EQ(out.texel, (std::vector<std::uint32_t>{3, 9}));
}

TEST(MeshSurface, WhereTrianglesOverlapTheSmallerIndexHasThePlace) {
  TriangleMesh mesh = square(1);
  for (const Vec3 p : square(1).positions) mesh.positions.push_back(p + Vec3{0, 0, 5});
  mesh.triangles.insert(mesh.triangles.begin(), {{4, 5, 7}, {4, 7, 6}});
  mesh.uv_triangles = {{0, 1, 3}, {0, 3, 2}, {0, 1, 3}, {0, 3, 2}};
  TexelPoints out;
  make_mesh_surface(mesh)->rasterize({8, 8}, {0, 0, 8, 8}, kCentre, {}, out);
  ASSERT_EQ(out.texel.size(), 64u);
  for (std::size_t i = 0; i < 64; ++i) EXPECT_EQ(out.points.position[2][i], 5);
}

TEST(MeshSurface, APlaceKnowsItsUv_AndTheTexelThereLiesAtThatPlace) {
  const auto surface = make_mesh_surface(bent_square(9));
  Random random(1);
  for (int trial = 0; trial < 200; ++trial) {
    const float a = random.next_float(), b = random.next_float() * (1 - a);
    const HitCoordinates hit{random.below(162), {a, b}};
    SurfaceHit at;
    surface->complete({&hit, 1}, {&at, 1});
    // Put an offset of one texel exactly where the hit is.
    const int x = static_cast<int>(at.uv.x * 64), y = static_cast<int>(at.uv.y * 64);
    const Vec2 offset{at.uv.x * 64 - float(x), at.uv.y * 64 - float(y)};
    TexelPoints out;
    surface->rasterize({64, 64}, {x, y, 1, 1}, {&offset, 1}, {}, out);
    ASSERT_EQ(out.texel.size(), 1u);
    EXPECT_LT(length(out.points.position.get(0) - at.position), 1e-5f);
    EXPECT_LT(length(out.points.normal.get(0) - at.normal), 1e-4f);
    EXPECT_LT(length(out.points.tangent.get(0) - at.tangent), 1e-4f);
  }
}

TEST(MeshSurface, ChangesOfPositionAndNormalWithUvAreThoseOfFiniteDifferences) {
  const auto surface = make_mesh_surface(bent_square(5));
  const float step = 1e-3f;
  for (std::uint32_t triangle = 0; triangle < 50; ++triangle) {
    const HitCoordinates hits[3] = {
        {triangle, {0.3f, 0.3f}}, {triangle, {0.3f + step, 0.3f}}, {triangle, {0.3f, 0.3f + step}}};
    SurfaceHit at[3];
    surface->complete(hits, at);
    for (int k = 1; k < 3; ++k) {
      const Vec2 d = at[k].uv - at[0].uv;
      EXPECT_LT(length(at[k].position - at[0].position - at[0].dp_du * d.x - at[0].dp_dv * d.y), 2e-6f);
      EXPECT_LT(length(at[k].normal - at[0].normal - at[0].dn_du * d.x - at[0].dn_dv * d.y), 2e-6f);
    }
  }
}

TEST(MeshSurface, ChartsHangTogetherByPlaceAndUv_NotByIndex) {
  TriangleMesh mesh = square(2);
  // Every corner its own uv index, as some exporters write; and one triangle moved away in uv.
  TriangleMesh loose = mesh;
  loose.uv.clear(), loose.uv_triangles.clear();
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    for (int k = 0; k < 3; ++k) loose.uv.push_back(mesh.uv[mesh.uv_triangles[t][k]] * (t == 7 ? 0.1f : 0.5f));
    loose.uv_triangles.push_back({3 * t, 3 * t + 1, 3 * t + 2});
  }
  const auto surface = make_mesh_surface(loose);
  for (std::uint32_t t = 0; t < 8; ++t) {
    const HitCoordinates hit{t, {0.2f, 0.2f}};
    SurfaceHit at;
    surface->complete({&hit, 1}, {&at, 1});
    EXPECT_EQ(at.chart, t == 7 ? 1u : 0u);
  }
}

TEST(MeshSurface, TrianglesWithoutAreaInUvStayFinite) {
  TriangleMesh mesh = square(1);
  mesh.uv_triangles[1] = {0, 0, 0};
  const HitCoordinates hit{1, {0.25f, 0.25f}};
  SurfaceHit at;
  make_mesh_surface(mesh)->complete({&hit, 1}, {&at, 1});
  EXPECT_TRUE(std::isfinite(length(at.dp_du)) && std::isfinite(length(at.dp_dv)));
  EXPECT_GT(length(cross(at.dp_du, at.dp_dv)), 0);
}

TEST(MeshSurface, FingerprintChangesWithOneUv) {
  TriangleMesh mesh = square(3);
  const std::uint64_t before = make_mesh_surface(mesh)->fingerprint();
  EXPECT_EQ(before, make_mesh_surface(mesh)->fingerprint());
  mesh.uv[5].x += 1e-6f;
  EXPECT_NE(before, make_mesh_surface(mesh)->fingerprint());
}

TEST(MeshSurface, MeshesWithoutAnAtlasAreRefused) {
  TriangleMesh mesh = square(1);
  mesh.uv[0].x = 3;
  EXPECT_THROW(make_mesh_surface(mesh), Error);
  EXPECT_THROW(make_mesh_surface(icosphere(1)), Error);
  EXPECT_THROW(make_mesh_surface({}), Error);
}

}  // namespace
}  // namespace redmap
