// Maps baked on a device against those baked on the CPU: two compilers, two ways through the texels.
#include "gpu/bake.h"

#include <gtest/gtest.h>

#include "gpu/bake_rows.h"
#include "surface/atlas.h"
#include "surface/mesh.h"
#include "surface/shapes.h"

namespace redmap {
namespace {

std::shared_ptr<const Surface> hilly_mesh() {
  TriangleMesh mesh = bumpy_sphere(3);
  unwrap(mesh);
  return make_mesh_surface(std::move(mesh));
}

class BakeParity : public testing::TestWithParam<std::string> {
 protected:
  void expect_same_map(const Surface& surface, int size) {
    const bench::BakeRow row = bench::measure_bake(surface, GetParam(), size, "");
    ASSERT_TRUE(row.difference.same_basis);
    EXPECT_LE(row.difference.mean_weight, 1e-3);
    // A threshold flips a sub-point where the last bits differ.
    EXPECT_LE(static_cast<double>(row.difference.flipped), 1e-3 * static_cast<double>(row.difference.covered) + 1);
  }
};
INSTANTIATE_TEST_SUITE_P(Library, BakeParity, testing::ValuesIn(library_shader_names()),
                         [](const auto& test) { return test.param; });

TEST_P(BakeParity, OnASphereAndOnAMesh_MapsEqualTheCpus) {
  static const std::shared_ptr<const Surface> sphere = make_sphere(1), mesh = hilly_mesh();
  expect_same_map(*sphere, 64);
  expect_same_map(*mesh, 96);
}

}  // namespace
}  // namespace redmap
