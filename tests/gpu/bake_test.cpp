// Maps baked on a device against those baked on the CPU: two compilers, two ways through the texels.
#include "gpu/bake.h"

#include <gtest/gtest.h>

#include <fstream>

#include "base/parallel.h"
#include "base/temporary_folder.h"
#include "gpu/bake_rows.h"
#include "surface/atlas.h"
#include "surface/mesh.h"
#include "surface/shapes.h"
#include "user_shader/user_shader.h"

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
    // The last bits decide some thresholds: of sub-points, and of keys, which texels of a small map share by the dozen.
    EXPECT_LE(static_cast<double>(row.difference.flipped), 1e-3 * static_cast<double>(row.difference.covered) + 12);
  }
};
INSTANTIATE_TEST_SUITE_P(Library, BakeParity, testing::ValuesIn(library_shader_names()),
                         [](const auto& test) { return test.param; });

TEST_P(BakeParity, OnASphereAndOnAMesh_MapsEqualTheCpus) {
  static const std::shared_ptr<const Surface> sphere = make_sphere(1), mesh = hilly_mesh();
  expect_same_map(*sphere, 48);
  expect_same_map(*mesh, 64);
}

// A user's own text, written for one test.
std::shared_ptr<const Shader> own_shader(const TemporaryFolder& folder, const std::string& pattern_body) {
  const std::filesystem::path file = folder / "mine.glsl";
  std::ofstream(file) << "// Mine.\nstruct Parameters {\n  float a;  // 1 [0, 1]: a\n};\nstruct Pattern { float b; };\n"
                         "Pattern pattern(Surface at, Parameters p) {\n  float b = p.a;\n"
                      << pattern_body
                      << "  return Pattern(b);\n}\n"
                         "vec3 radiance(Pattern m, vec3 l, vec3 v) { return vec3(m.b * max(l.z, 0.0)); }\n";
  return make_user_shader(file, "mine.glsl");
}

std::string complaint(const Shader& shader, const std::unique_ptr<TexelPasses>& passes) {
  BakeOptions options;
  options.size = 64;
  try {
    bake(*make_sphere(1), shader, options, *passes);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(BakeOnDevice, AShaderThatNeverEndsOnASmallPart_IsNamedWithItsFunctionAndPlace) {
  const TemporaryFolder folder;
  const auto shader = own_shader(folder, "  for (int i = 0; at.position.y > 0.99 && i >= 0; i = 1 - i) b += 1e-9;\n");
  const std::string found = complaint(*shader, make_device_passes());
  EXPECT_NE(found.find("mine.glsl"), std::string::npos) << found;
  EXPECT_NE(found.find("pattern(): expected loops that end"), std::string::npos) << found;
  EXPECT_NE(found.find("position ("), std::string::npos) << found;
}

TEST(BakeOnDevice, NotANumber_IsTheSameErrorAsOnTheCpu) {
  const TemporaryFolder folder;
  const auto shader = own_shader(folder, "  if (at.position.y > 0.9) b = log(-1.0 - b);\n");
  const std::string found = complaint(*shader, make_device_passes());
  EXPECT_NE(found.find("expected finite numbers, found"), std::string::npos) << found;
  EXPECT_EQ(found.substr(0, found.find(", at")), [&] {
    const std::string cpu = complaint(*shader, make_cpu_passes());
    return cpu.substr(0, cpu.find(", at"));
  }());
}

TEST(BakeOnDevice, IsTheSameBytesEveryTime_ForAnyNumberOfThreads) {
  const auto shader = make_library_shader("marble");
  const auto surface = make_sphere(1);
  BakeOptions options;
  options.size = 128;
  const auto bytes = [&](std::size_t threads) {
    const ThreadLimit limit(threads);
    const ReductionMap map = bake(*surface, *shader, options, *make_device_passes());
    std::vector<std::uint8_t> all;
    for (int y = 0; y < map.weights.extent(0).height; ++y)
      all.insert(all.end(), map.weights.row(0, y).begin(), map.weights.row(0, y).end());
    return all;
  };
  const std::vector<std::uint8_t> once = bytes(1);
  EXPECT_EQ(once, bytes(2));
  EXPECT_EQ(once, bytes(7));
}

TEST(BakeOnDevice, StopsWhereItIsAskedTo) {
  BakeOptions options;
  options.size = 64;
  options.progress = [](float fraction, std::string_view) { return fraction < 0.3f; };
  EXPECT_THROW(bake(*make_sphere(1), *make_library_shader("noise"), options, *make_device_passes()), BakeInterrupted);
}

TEST(BakeOnDevice, WhatOnlyTheCpuCan_IsSaid) {
  BakeOptions options;
  EXPECT_EQ(reason_to_bake_on_cpu(*make_library_shader("noise"), options), "");
  options.selection = BasisSelection::kPaper;
  EXPECT_NE(reason_to_bake_on_cpu(*make_library_shader("noise"), options), "");
}

TEST(BakeOnDevice, ADeviceThatIsNotThere_IsAnErrorThatNamesThoseThatAre) {
  EXPECT_NE(complaint(*make_library_shader("noise"), make_device_passes("no such device")).find("no such device"),
            std::string::npos);
}

}  // namespace
}  // namespace redmap
