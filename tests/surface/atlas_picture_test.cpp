// The drawn atlas: charts where they are, outlines around them, white elsewhere.
#include <gtest/gtest.h>

#include "base/error.h"
#include "shapes.h"
#include "surface/atlas_picture.h"

namespace redmap {
namespace {

bool is_white(Rgb c) { return c.r > 0.99f && c.g > 0.99f && c.b > 0.99f; }
bool is_dark(Rgb c) { return std::max({c.r, c.g, c.b}) < 0.1f; }

TEST(AtlasPicture, TwoChartsHaveTwoColours_OutlinesAndAWhiteGap_WithVUpwards) {
  // One chart in the lower left quarter, one in the upper right.
  TriangleMesh mesh = square(2);
  const TriangleMesh one = square(2);
  for (Vec2& uv : mesh.uv) uv = uv * 0.4f + Vec2{0.05f, 0.05f};
  for (std::size_t i = 0; i < one.uv.size(); ++i) {
    mesh.positions.push_back(one.positions[i] + Vec3{0, 0, 1});
    mesh.uv.push_back(one.uv[i] * 0.4f + Vec2{0.55f, 0.55f});
  }
  for (const auto& [a, b, c] : one.triangles) mesh.triangles.push_back({a + 9, b + 9, c + 9});
  mesh.uv_triangles = mesh.triangles;

  const Image image = draw_atlas(mesh, 100);
  const Rgb first = image.rgb(25, 74), second = image.rgb(75, 25);
  EXPECT_FALSE(is_white(first) || is_dark(first) || is_white(second) || is_dark(second));
  EXPECT_NE(first, second);
  EXPECT_EQ(first, image.rgb(20, 70)) << "one colour throughout, over inner edges too";
  EXPECT_TRUE(is_dark(image.rgb(5, 74))) << "the left outline";
  EXPECT_TRUE(is_white(image.rgb(50, 50)));
  EXPECT_TRUE(is_white(image.rgb(25, 25)));
  EXPECT_THROW(draw_atlas(icosphere(0), 10), Error);
}

}  // namespace
}  // namespace redmap
