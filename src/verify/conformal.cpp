#include "verify/conformal.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/error.h"

namespace redmap {

namespace {

/// A kind with fewer cases takes the scale of all: an RMS of eight is right to a quarter.
constexpr std::size_t kFewestOfKind = 8;

std::vector<double> estimate_scales(std::span<const ErrorOfKind> cases, int kinds) {
  std::vector<double> squares(kinds + 1);
  std::vector<std::size_t> counts(kinds + 1);
  for (std::size_t i = 0; i < cases.size(); i += 2)
    for (const int kind : {cases[i].kind, kinds}) squares[kind] += cases[i].error * cases[i].error, ++counts[kind];
  std::vector<double> scales(kinds);
  const double of_all = std::sqrt(squares[kinds] / static_cast<double>(std::max<std::size_t>(1, counts[kinds])));
  for (int kind = 0; kind < kinds; ++kind)
    scales[kind] = counts[kind] < kFewestOfKind ? of_all : std::sqrt(squares[kind] / static_cast<double>(counts[kind]));
  // A kind that came out free of errors may still have some.
  const double least = std::max(1e-3 * of_all, 1e-9);
  for (double& scale : scales) scale = std::max(scale, least);
  return scales;
}

}  // namespace

std::size_t fewest_cases(double coverage) {
  // The bound is the largest error seen at least: rank <= count below.
  return static_cast<std::size_t>(std::ceil(coverage / (1 - coverage) - 1e-9));
}

double conformal_bound(std::vector<double> errors, double coverage) {
  if (!(coverage > 0 && coverage < 1)) throw Error("coverage: expected a number between 0 and 1, found {}", coverage);
  if (errors.size() < fewest_cases(coverage))
    throw Error("a bound of coverage {}: expected at least {} cases, found {}", coverage, fewest_cases(coverage),
                errors.size());
  // The smallest error that is no less than `coverage` of these and of one more, wherever that falls.
  const auto rank = static_cast<std::size_t>(std::ceil(coverage * static_cast<double>(errors.size() + 1) - 1e-9));
  std::nth_element(errors.begin(), errors.begin() + static_cast<std::ptrdiff_t>(rank - 1), errors.end());
  return errors[rank - 1];
}

ConformalBounds::ConformalBounds(std::span<const ErrorOfKind> cases, int kinds, double coverage)
    : scales_(estimate_scales(cases, kinds)) {
  std::vector<double> scores;
  for (std::size_t i = 1; i < cases.size(); i += 2) scores.push_back(cases[i].error / scales_[cases[i].kind]);
  quantile_ = conformal_bound(std::move(scores), coverage);
}

}  // namespace redmap
