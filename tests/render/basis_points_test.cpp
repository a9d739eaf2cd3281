// The basis of a map, bound: every pattern is the shader at its own place.
#include <gtest/gtest.h>

#include "map/reduction_map.h"
#include "shader/shader.h"

namespace redmap {
namespace {

TEST(BasisPoints, EveryPattern_IsTheShaderAtItsPlace) {
  const std::shared_ptr<const Shader> shader = make_library_shader("marble");
  ReductionMap map;
  for (int b = 0; b < 11; ++b) {
    const float t = 0.37f * static_cast<float>(b);
    map.basis.push_back({{t, 1 - t, 0.3f}, normalized({t, 1, 2}), normalized({-1, t, 0}), {0.05f * t, 0.1f}});
  }
  const std::unique_ptr<BoundPatterns> basis = shader->bind(basis_points(map));
  ASSERT_EQ(basis->size(), 11u);
  DirectionPairs pairs;
  pairs.resize(1);
  for (std::size_t i = 0; i < pairs.to_light.stride(); ++i)
    pairs.to_light.set(i, normalized({0.3f, 0.1f, 1})), pairs.to_viewer.set(i, normalized({-0.2f, 0.1f, 1}));
  for (std::size_t b = 0; b < map.basis.size(); ++b) {
    ReductionMap alone;
    alone.basis = {map.basis[b]};
    Planes<3> expected, found;
    shader->bind(basis_points(alone))->radiance_one(0, pairs, expected);
    basis->radiance_one(b, pairs, found);
    EXPECT_EQ(found.get(0), expected.get(0)) << b;
    EXPECT_GT(length(found.get(0)), 0);
  }
}

}  // namespace
}  // namespace redmap
