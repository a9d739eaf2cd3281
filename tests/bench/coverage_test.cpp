#include "coverage/coverage.h"

#include <gtest/gtest.h>

namespace redmap::bench {
namespace {

TEST(Coverage, CertificateHolds_OnFramesItNeverSaw) {
  CoverageOptions options;
  options.objects = {"sphere"}, options.shaders = {"noise"};
  options.map_size = 64, options.scenes = 150, options.reference_spp = 256;
  options.verify.pixels = 200, options.verify.spp = 256, options.verify.minifications = {1, 2, 4};
  const std::vector<CoverageRow> rows = measure_coverage(options);
  ASSERT_EQ(rows.size(), 1u);
  EXPECT_GT(rows[0].pixels, 300);
  // 95 % is stated; that many pixels, four of a scene together, are right to 2 %.
  EXPECT_GT(rows[0].coverage, 0.91);
  EXPECT_LT(rows[0].coverage, 0.99);
  EXPECT_LT(rows[0].mean_bound, 3 * rows[0].rms_error);
}

}  // namespace
}  // namespace redmap::bench
