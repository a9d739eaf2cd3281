// Bounds that hold as often as they say: split conformal prediction with scaled residuals (Lei, G'Sell, Rinaldo,
// Tibshirani and Wasserman 2018, "Distribution-Free Predictive Inference for Regression", section 5.2). One half of
// the cases says how large errors are of each kind of case, the other half how often that is exceeded.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace redmap {

/// An error that was seen, and what kind of case it was seen in: kinds are [0, kinds).
struct ErrorOfKind {
  double error = 0;  ///< from 0 up
  int kind = 0;
};

/// Fewest cases of one kind for which a bound of that coverage exists.
std::size_t fewest_cases(double coverage);

/// A new error drawn like these is at most this with a probability of `coverage` or more: plain conformal prediction,
/// for cases of one kind. Throws Error with fewer than fewest_cases(coverage).
double conformal_bound(std::vector<double> errors, double coverage);

class ConformalBounds {
 public:
  ConformalBounds() = default;
  /// Cases with even indices give the scales, those with odd ones the quantile: the order has to be random. `coverage`
  /// in (0, 1). Throws Error where the odd ones are too few.
  ConformalBounds(std::span<const ErrorOfKind> cases, int kinds, double coverage);

  /// A new case of that kind, drawn like the others, has at most this error with a probability of `coverage` or more.
  double bound(int kind) const { return quantile_ * scales_[kind]; }

 private:
  std::vector<double> scales_;
  double quantile_ = 0;
};

}  // namespace redmap
