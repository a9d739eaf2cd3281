// A device and the CPU are two implementations of the same pictures.
#include "gpu/parity.h"

#include <gtest/gtest.h>

#include <cstdlib>

#include "shader/shader.h"
#include "surface/atlas.h"
#include "surface/shapes.h"

namespace redmap {
namespace {

[[maybe_unused]] const int kLayerAskedFor = setenv("VK_INSTANCE_LAYERS", "VK_LAYER_KHRONOS_validation", 0);

class LibraryOnDevice : public testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(Library, LibraryOnDevice, testing::ValuesIn(library_shader_names()),
                         [](const auto& test) { return test.param; });

TEST_P(LibraryOnDevice, LooksAsOnTheCpuFromEverywhere) {
  bench::ParityOptions options;
  options.shaders = {GetParam()};
  for (const bench::ParityRow& row : bench::measure_parity(make_sphere(1), options))
    EXPECT_LE(row.rmse, .002) << row.distance << " texels across a pixel, largest error " << row.max_error;
}

/// Charts, seams and clusters of an atlas.
TEST(MeshOnDevice, LooksAsOnTheCpuFromEverywhere) {
  TriangleMesh mesh = torus(64, 32, 1, 0.4f);
  unwrap(mesh);
  compute_normals(mesh);
  bench::ParityOptions options;
  options.shaders = {"noise", "stone", "transparent"};
  for (const bench::ParityRow& row : bench::measure_parity(make_mesh_surface(std::move(mesh)), options))
    EXPECT_LE(row.rmse, row.shader == "transparent" ? .002 : .001)
        << row.shader << " at " << row.distance << ", largest error " << row.max_error;
}

}  // namespace
}  // namespace redmap
