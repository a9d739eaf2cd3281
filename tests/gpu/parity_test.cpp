// A device and the CPU are two implementations of the same pictures.
#include "gpu/parity.h"

#include <gtest/gtest.h>

#include <cstdlib>

namespace redmap {
namespace {

[[maybe_unused]] const int kLayerAskedFor = setenv("VK_INSTANCE_LAYERS", "VK_LAYER_KHRONOS_validation", 0);

class LibraryOnDevice : public testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(Library, LibraryOnDevice, testing::ValuesIn(bench::device_shaders()),
                         [](const auto& test) { return test.param; });

TEST_P(LibraryOnDevice, LooksAsOnTheCpuFromEverywhere) {
  bench::ParityOptions options;
  options.shaders = {GetParam()};
  for (const bench::ParityRow& row : bench::measure_parity(options))
    EXPECT_LE(row.rmse, .002) << row.distance << " texels across a pixel, largest error " << row.max_error;
}

/// Charts and clusters of an atlas. The bunny is fetched, not committed: nothing to test where it is not.
TEST(MeshOnDevice, LooksAsOnTheCpuFromEverywhere) {
  bench::ParityOptions options;
  options.object = "bunny", options.shaders = {"noise", "stone"}, options.models = REDMAP_MODELS;
  if (!std::filesystem::exists(options.models / "bunny_10k.obj")) GTEST_SKIP();
  for (const bench::ParityRow& row : bench::measure_parity(options))
    EXPECT_LE(row.rmse, .001) << row.shader << " at " << row.distance << ", largest error " << row.max_error;
}

}  // namespace
}  // namespace redmap
