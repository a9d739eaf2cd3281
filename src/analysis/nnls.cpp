#include "analysis/nnls.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace redmap {
namespace {

using Vector = std::array<double, kMaxUnknowns>;

/// Gradients below this part of the projection are zero, and pivots below this part of the diagonal singular: both a
/// few digits above double precision.
constexpr double kGradientTolerance = 1e-10, kPivotTolerance = 1e-13;

/// The unknowns that may be positive at the moment, and their number.
struct PassiveSet {
  std::array<int, kMaxUnknowns> index;
  int size = 0;

  bool contains(int i) const { return std::find(index.begin(), index.begin() + size, i) != index.begin() + size; }
  void remove_zeros(const double* weights) {
    size = static_cast<int>(
        std::remove_if(index.begin(), index.begin() + size, [&](int i) { return weights[i] <= 0; }) - index.begin());
  }
};

/// Least squares over the passive unknowns alone, by Cholesky factorisation. False if they depend on each other.
bool solve_passive(const PassiveSet& passive, const double* gram, const double* projection, Vector& solution) {
  double factor[kMaxUnknowns][kMaxUnknowns];
  for (int i = 0; i < passive.size; ++i) {
    const double* gram_row = gram + passive.index[i] * kMaxUnknowns;
    for (int j = 0; j <= i; ++j) {
      double sum = gram_row[passive.index[j]];
      for (int q = 0; q < j; ++q) sum -= factor[i][q] * factor[j][q];
      if (i == j && !(sum > kPivotTolerance * gram_row[passive.index[i]])) return false;
      factor[i][j] = i == j ? std::sqrt(sum) : sum / factor[j][j];
    }
    double sum = projection[passive.index[i]];
    for (int q = 0; q < i; ++q) sum -= factor[i][q] * solution[q];
    solution[i] = sum / factor[i][i];
  }
  for (int i = passive.size - 1; i >= 0; --i) {
    for (int q = i + 1; q < passive.size; ++q) solution[i] -= factor[q][i] * solution[q];
    solution[i] /= factor[i][i];
  }
  return true;
}

/// The unknown outside the passive set whose growth would help most; -1 if none would.
int steepest_unknown(int count, const double* gram, const double* projection, const PassiveSet& passive,
                     const std::array<bool, kMaxUnknowns>& barred, const double* weights) {
  int best = -1;
  double best_gradient = 0;
  for (int i = 0; i < count; ++i) {
    if (barred[i] || passive.contains(i)) continue;
    double gradient = projection[i];
    for (int j = 0; j < passive.size; ++j)
      gradient -= gram[i * kMaxUnknowns + passive.index[j]] * weights[passive.index[j]];
    if (gradient > best_gradient && gradient > kGradientTolerance * std::abs(projection[i]))
      best = i, best_gradient = gradient;
  }
  return best;
}

/// Walks from `weights` towards `solution` as far as nothing becomes negative. True if it arrives.
bool step_towards(const Vector& solution, PassiveSet& passive, double* weights) {
  double part = 1;
  int blocking = -1;
  for (int i = 0; i < passive.size; ++i) {
    const double weight = weights[passive.index[i]];
    if (solution[i] > 0) continue;
    const double reach = weight / std::max(weight - solution[i], 1e-300);
    if (blocking < 0 || reach < part) part = reach, blocking = passive.index[i];
  }
  for (int i = 0; i < passive.size; ++i) {
    double& weight = weights[passive.index[i]];
    weight = std::max(0.0, weight + part * (solution[i] - weight));
  }
  if (blocking < 0) return true;
  weights[blocking] = 0;
  passive.remove_zeros(weights);
  return false;
}

}  // namespace

void solve_nnls(int count, const double* gram, const double* projection, double* weights) {
  std::fill_n(weights, count, 0.0);
  PassiveSet passive;
  std::array<bool, kMaxUnknowns> barred{};
  // Every round lowers the residual, so no passive set comes back; the bound is for rounding alone.
  for (int round = 0; round < 4 * kMaxUnknowns; ++round) {
    const int entering = steepest_unknown(count, gram, projection, passive, barred, weights);
    if (entering < 0) return;
    passive.index[passive.size++] = entering;
    Vector solution;
    for (;;) {
      if (!solve_passive(passive, gram, projection, solution)) {
        // A column that the others span already adds nothing: leave it out for good.
        barred[entering] = true;
        weights[entering] = 0;
        passive.size = static_cast<int>(
            std::remove(passive.index.begin(), passive.index.begin() + passive.size, entering) - passive.index.begin());
        break;
      }
      if (step_towards(solution, passive, weights)) break;
    }
  }
}

}  // namespace redmap
