// Non-negative least squares against trying every set of positive unknowns.
#include "analysis/nnls.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

#include "base/random.h"

namespace redmap {
namespace {

using Columns = std::vector<std::vector<double>>;

struct Normal {
  std::array<double, kMaxUnknowns * kMaxUnknowns> gram{};
  std::array<double, kMaxUnknowns> projection{};
};

Normal normal_equations(const Columns& columns, const std::vector<double>& v) {
  Normal normal;
  for (std::size_t i = 0; i < columns.size(); ++i) {
    for (std::size_t j = 0; j < columns.size(); ++j)
      for (std::size_t r = 0; r < v.size(); ++r) normal.gram[i * kMaxUnknowns + j] += columns[i][r] * columns[j][r];
    for (std::size_t r = 0; r < v.size(); ++r) normal.projection[i] += columns[i][r] * v[r];
  }
  return normal;
}

double residual_square(const Columns& columns, const std::vector<double>& v, const double* w) {
  double sum = 0;
  for (std::size_t r = 0; r < v.size(); ++r) {
    double rest = v[r];
    for (std::size_t i = 0; i < columns.size(); ++i) rest -= w[i] * columns[i][r];
    sum += rest * rest;
  }
  return sum;
}

/// Least squares over `members` by Gauss elimination with pivoting.
bool solve_subset(const Normal& normal, const std::vector<int>& members, std::vector<double>& w) {
  const int n = static_cast<int>(members.size());
  std::vector<std::vector<double>> m(n, std::vector<double>(n + 1));
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) m[i][j] = normal.gram[members[i] * kMaxUnknowns + members[j]];
    m[i][n] = normal.projection[members[i]];
  }
  for (int i = 0; i < n; ++i) {
    int pivot = i;
    for (int r = i; r < n; ++r)
      if (std::abs(m[r][i]) > std::abs(m[pivot][i])) pivot = r;
    if (std::abs(m[pivot][i]) < 1e-12) return false;
    std::swap(m[i], m[pivot]);
    for (int r = 0; r < n; ++r)
      if (r != i)
        for (int c = n; c >= i; --c) m[r][c] -= m[r][i] / m[i][i] * m[i][c];
  }
  for (int i = 0; i < n; ++i) w[members[i]] = m[i][n] / m[i][i];
  return true;
}

double exhaustive_residual_square(const Columns& columns, const std::vector<double>& v) {
  const Normal normal = normal_equations(columns, v);
  double best = residual_square(columns, v, std::vector<double>(columns.size()).data());
  for (unsigned set = 1; set < 1u << columns.size(); ++set) {
    std::vector<int> members;
    for (std::size_t i = 0; i < columns.size(); ++i)
      if (set >> i & 1) members.push_back(static_cast<int>(i));
    std::vector<double> w(columns.size());
    if (!solve_subset(normal, members, w)) continue;
    bool positive = true;
    for (double x : w) positive = positive && x >= 0;
    if (positive) best = std::min(best, residual_square(columns, v, w.data()));
  }
  return best;
}

Columns random_columns(Random& random, int count, int rows, double offset) {
  Columns columns(count, std::vector<double>(rows));
  for (auto& column : columns)
    for (double& x : column) x = random.next_float() - offset;
  return columns;
}

TEST(Nnls, FindsTheBestOfAllActiveSets) {
  Random random(1);
  for (int trial = 0; trial < 400; ++trial) {
    const int count = 1 + static_cast<int>(random.below(7));
    const Columns columns = random_columns(random, count, 12, trial % 2 ? 0.0 : 0.5);
    std::vector<double> v(12);
    for (double& x : v) x = random.next_float() - 0.3;
    const Normal normal = normal_equations(columns, v);
    double w[kMaxUnknowns];
    solve_nnls(count, normal.gram.data(), normal.projection.data(), w);
    for (int i = 0; i < count; ++i) ASSERT_GE(w[i], 0);
    ASSERT_NEAR(residual_square(columns, v, w), exhaustive_residual_square(columns, v), 1e-9) << "trial " << trial;
  }
}

TEST(Nnls, RecoversPlantedWeights_OfSixteen) {
  Random random(2);
  for (int trial = 0; trial < 50; ++trial) {
    const Columns columns = random_columns(random, kMaxUnknowns, 105, 0);
    double planted[kMaxUnknowns], w[kMaxUnknowns];
    std::vector<double> v(105);
    for (int i = 0; i < kMaxUnknowns; ++i) {
      planted[i] = random.next_float() < 0.5f ? 0 : random.next_float();
      for (int r = 0; r < 105; ++r) v[r] += planted[i] * columns[i][r];
    }
    const Normal normal = normal_equations(columns, v);
    solve_nnls(kMaxUnknowns, normal.gram.data(), normal.projection.data(), w);
    for (int i = 0; i < kMaxUnknowns; ++i) ASSERT_NEAR(w[i], planted[i], 1e-7);
  }
}

TEST(Nnls, EqualAndZeroColumns_DoNoHarm) {
  const Columns columns{{1, 2, 3}, {1, 2, 3}, {0, 0, 0}, {2, 4, 6}};
  const std::vector<double> v{0.5, 1, 1.5};
  const Normal normal = normal_equations(columns, v);
  double w[kMaxUnknowns];
  solve_nnls(4, normal.gram.data(), normal.projection.data(), w);
  for (int i = 0; i < 4; ++i) ASSERT_GE(w[i], 0);
  EXPECT_NEAR(residual_square(columns, v, w), 0, 1e-12);
}

TEST(Nnls, WhatPointsAway_GetsNothing) {
  const Columns columns{{1, 0}, {0, 1}};
  const Normal normal = normal_equations(columns, {-1, -2});
  double w[kMaxUnknowns] = {7, 7};
  solve_nnls(2, normal.gram.data(), normal.projection.data(), w);
  EXPECT_EQ(w[0], 0);
  EXPECT_EQ(w[1], 0);
}

}  // namespace
}  // namespace redmap
