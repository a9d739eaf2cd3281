#include "analysis/basis.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "base/parallel.h"

namespace redmap {
namespace {

/// Vectors a thread works on at a time.
constexpr std::size_t kChunk = 256;

/// Eight partial sums, so that the loop is done in lanes.
float dot_rows(const float* a, const float* b, int rows) {
  float sums[8] = {};
  int r = 0;
  for (; r + 8 <= rows; r += 8)
    for (int i = 0; i < 8; ++i) sums[i] += a[r + i] * b[r + i];
  for (; r < rows; ++r) sums[r % 8] += a[r] * b[r];
  return ((sums[0] + sums[4]) + (sums[1] + sums[5])) + ((sums[2] + sums[6]) + (sums[3] + sums[7]));
}

struct Worst {
  float residual = -1;
  std::size_t index = 0;
};

/// The vector that `basis` fits worst; ties go to the smaller index. Residuals only fall while a basis grows, so
/// vectors below half the tolerance are `settled` and not looked at again.
Worst find_worst(const ReflectanceVectors& vectors, const ReflectanceBasis& basis, float tolerance,
                 std::vector<std::uint8_t>& settled) {
  std::vector<Worst> of_chunk((vectors.size() + kChunk - 1) / kChunk);
  parallel_for(of_chunk.size(), [&](std::size_t chunk) {
    BasisWeights weights;
    for (std::size_t i = chunk * kChunk; i < std::min(vectors.size(), (chunk + 1) * kChunk); ++i) {
      if (settled[i]) continue;
      const float residual = basis.fit(vectors[i], weights);
      settled[i] = basis.size() > 0 && residual < 0.5f * tolerance;
      if (residual > of_chunk[chunk].residual) of_chunk[chunk] = {residual, i};
    }
  });
  Worst worst;
  for (const Worst& w : of_chunk)
    if (w.residual > worst.residual) worst = w;
  return worst;
}

float largest_residual(const ReflectanceVectors& vectors, const ReflectanceBasis& basis) {
  std::vector<std::uint8_t> settled(vectors.size());
  return std::max(0.0f, find_worst(vectors, basis, 0, settled).residual);
}

}  // namespace

void ReflectanceBasis::add(const float* scaled) {
  vectors_.insert(vectors_.end(), scaled, scaled + rows_);
  const float* added = &vectors_[static_cast<std::size_t>(size_) * rows_];
  for (int i = 0; i <= size_; ++i) {
    double sum = 0;
    const float* other = &vectors_[static_cast<std::size_t>(i) * rows_];
    for (int r = 0; r < rows_; ++r) sum += static_cast<double>(other[r]) * added[r];
    gram_[i * kMaxUnknowns + size_] = gram_[size_ * kMaxUnknowns + i] = sum;
  }
  ++size_;
}

void ReflectanceBasis::remove(int index) {
  const std::vector<float> vectors = std::move(vectors_);
  const int count = std::exchange(size_, 0);
  vectors_.clear();
  for (int i = 0; i < count; ++i)
    if (i != index) add(&vectors[static_cast<std::size_t>(i) * rows_]);
}

float ReflectanceBasis::fit(const float* scaled, BasisWeights& weights) const {
  double projection[kMaxUnknowns], solution[kMaxUnknowns];
  for (int i = 0; i < size_; ++i)
    projection[i] = dot_rows(&vectors_[static_cast<std::size_t>(i) * rows_], scaled, rows_);
  solve_nnls(size_, gram_.data(), projection, solution);
  weights = {};
  for (int i = 0; i < size_; ++i) weights[i] = static_cast<float>(solution[i]);

  // The residual row by row: squares of sums through the Gram matrix would lose half the digits.
  float square = 0;
  constexpr int kBlock = 32;
  for (int first = 0; first < rows_; first += kBlock) {
    const int count = std::min(kBlock, rows_ - first);
    float rest[kBlock];
    std::copy_n(scaled + first, count, rest);
    for (int i = 0; i < size_; ++i) {
      if (weights[i] == 0) continue;
      const float* vector = &vectors_[static_cast<std::size_t>(i) * rows_ + first];
      for (int r = 0; r < count; ++r) rest[r] -= weights[i] * vector[r];
    }
    square += dot_rows(rest, rest, count);
  }
  // NaN would pass every comparison with a tolerance.
  return std::isfinite(square) ? std::sqrt(square / static_cast<float>(rows_)) : std::numeric_limits<float>::infinity();
}

float ReflectanceBasis::distance(const float* weights_a, const float* weights_b) const {
  double square = 0;
  for (int i = 0; i < size_; ++i)
    for (int j = 0; j < size_; ++j)
      square += gram_[i * kMaxUnknowns + j] * (weights_a[i] - weights_b[i]) * (weights_a[j] - weights_b[j]);
  return static_cast<float>(std::sqrt(std::max(0.0, square) / rows_));
}

BasisChoice choose_basis(const ReflectanceVectors& vectors, float tolerance, int max_basis,
                         std::span<const std::size_t> start) {
  max_basis = std::min(max_basis, kMaxUnknowns);
  BasisChoice choice;
  ReflectanceBasis basis(vectors.rows);
  for (std::size_t i : start) basis.add(vectors[i]), choice.chosen.push_back(i);

  std::vector<std::uint8_t> settled(vectors.size());
  while (vectors.size() > 0) {
    const Worst worst = find_worst(vectors, basis, tolerance, settled);
    choice.residual = std::max(0.0f, worst.residual);
    // The first is always taken: a black surface has a basis too.
    if ((basis.size() > 0 && worst.residual < tolerance) || basis.size() >= max_basis) break;
    basis.add(vectors[worst.index]), choice.chosen.push_back(worst.index);
  }

  // Early choices can turn out to be mixtures of later ones.
  for (int i = basis.size() - 1; i >= static_cast<int>(start.size()) && basis.size() > 1; --i) {
    ReflectanceBasis fewer = basis;
    fewer.remove(i);
    const float residual = largest_residual(vectors, fewer);
    if (residual >= std::max(tolerance, choice.residual)) continue;
    basis = std::move(fewer);
    choice.chosen.erase(choice.chosen.begin() + i);
    choice.residual = residual;
  }
  return choice;
}

}  // namespace redmap
