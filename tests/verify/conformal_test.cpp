#include "verify/conformal.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "base/error.h"
#include "base/random.h"

namespace redmap {
namespace {

TEST(Conformal, NineteenErrors_AreTheFewestFor95Percent_AndTheirLargestIsTheBound) {
  std::vector<double> errors;
  for (int i = 1; i <= 18; ++i) errors.push_back(i);
  EXPECT_EQ(fewest_cases(0.95), 19u);
  EXPECT_THROW(conformal_bound(errors, 0.95), Error);
  errors.push_back(0.5);
  EXPECT_EQ(conformal_bound(errors, 0.95), 18);
}

TEST(Conformal, HundredErrors_HaveTheir96thAsBound) {
  std::vector<double> errors;
  for (int i = 100; i >= 1; --i) errors.push_back(i);
  EXPECT_EQ(conformal_bound(errors, 0.95), 96);
}

TEST(Conformal, CoverageOutsideZeroToOne_IsRefused) {
  EXPECT_THROW(conformal_bound(std::vector<double>(50, 1.0), 0), Error);
  EXPECT_THROW(conformal_bound(std::vector<double>(50, 1.0), 1), Error);
}

/// Heavy tails, and kinds whose errors differ a hundredfold.
ErrorOfKind draw(Random& random) {
  const int kind = static_cast<int>(random.below(3));
  const double tail = -std::log(1 - random.next_float());
  return {std::pow(10.0, kind) * tail * tail, kind};
}

TEST(Conformal, BoundsOfHeavyTails_HoldAsOftenAsTheySay) {
  Random random(3);
  int held = 0, all = 0;
  for (int calibration = 0; calibration < 200; ++calibration) {
    std::vector<ErrorOfKind> seen;
    for (int i = 0; i < 200; ++i) seen.push_back(draw(random));
    const ConformalBounds bounds(seen, 3, 0.9);
    for (int i = 0; i < 200; ++i) {
      const ErrorOfKind fresh = draw(random);
      held += fresh.error <= bounds.bound(fresh.kind), ++all;
    }
  }
  // Exactly .9 to .91 is expected; 40 000 draws around 200 calibrations are right to .003.
  EXPECT_NEAR(static_cast<double>(held) / all, 0.905, 0.01);
}

TEST(Conformal, KindsWithLargerErrors_HaveLargerBounds) {
  Random random(4);
  std::vector<ErrorOfKind> seen;
  for (int i = 0; i < 600; ++i) seen.push_back(draw(random));
  const ConformalBounds bounds(seen, 3, 0.9);
  EXPECT_GT(bounds.bound(1), 2 * bounds.bound(0));
  EXPECT_GT(bounds.bound(2), 2 * bounds.bound(1));
}

}  // namespace
}  // namespace redmap
