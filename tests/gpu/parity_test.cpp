// A device and the CPU are two implementations of the same pictures.
#include "gpu/parity.h"

#include <gtest/gtest.h>

#include <cmath>
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

TriangleMesh unwrapped_torus() {
  TriangleMesh mesh = torus(64, 32, 1, 0.4f);
  unwrap(mesh);
  compute_normals(mesh);
  return mesh;
}

/// Charts, seams and clusters of an atlas.
TEST(MeshOnDevice, LooksAsOnTheCpuFromEverywhere) {
  bench::ParityOptions options;
  options.shaders = {"noise", "stone"};
  for (const bench::ParityRow& row : bench::measure_parity(make_mesh_surface(unwrapped_torus()), options))
    EXPECT_LE(row.rmse, .001) << row.shader << " at " << row.distance << ", largest error " << row.max_error;
}

/// Bent and stretched, so that frames at rest are others: black boxes, normals and grains of the shader's own.
TEST(DeformedMeshOnDevice, LooksAsOnTheCpuFromEverywhere) {
  PosedMesh mesh{unwrapped_torus(), unwrapped_torus()};
  for (Vec3& p : mesh.posed.positions) {
    const float turn = 0.8f * p.y + 0.5f * p.x;
    p = {1.2f * p.x, p.y * std::cos(turn) - p.z * std::sin(turn), p.y * std::sin(turn) + p.z * std::cos(turn)};
  }
  mesh.posed.normals.clear();
  const auto surface = make_posed_surface(std::move(mesh));
  bench::ParityOptions options;
  options.shaders = {"noise", "toon_black_box", "raised_scales", "scratched_metal"};
  options.distances = {0.4, 6};
  for (const bench::ParityRow& row : bench::measure_parity(surface, options))
    EXPECT_LE(row.rmse, .002) << row.shader << " at " << row.distance << ", largest error " << row.max_error;
}

/// Convex: through other glass its own far sides are seen, whose outlines no mask knows.
TEST(GlassMeshOnDevice, LooksAsOnTheCpuFromEverywhere_AtRestAndDeformed) {
  TriangleMesh rest = icosphere(4);
  unwrap(rest);
  compute_normals(rest);
  PosedMesh posed{rest, rest};
  for (Vec3& p : posed.posed.positions) p = {1.2f * p.x + 0.2f * p.y, p.y, 0.8f * p.z - 0.1f * p.x};
  posed.posed.normals.clear();
  bench::ParityOptions options;
  options.shaders = {"transparent"};
  for (const auto& surface : {make_mesh_surface(std::move(rest)), make_posed_surface(std::move(posed))})
    for (const bench::ParityRow& row : bench::measure_parity(surface, options))
      EXPECT_LE(row.rmse, .002) << row.distance << " texels across a pixel, largest error " << row.max_error;
}

}  // namespace
}  // namespace redmap
