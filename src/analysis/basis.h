// Choosing the few reflectances that all others are non-negative mixtures of, and projecting onto them (paper, section
// 4.2.2). The paper says that non-negative least squares finds them; it selects nothing by itself, so we choose
// greedily what the cone of those chosen fits worst (docs/bake.md).
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "analysis/nnls.h"

namespace redmap {

/// Reflectances in rows, each of `rows` scaled numbers.
struct ReflectanceVectors {
  std::span<const float> values;
  int rows = 0;
  std::size_t size() const { return rows ? values.size() / rows : 0; }
  const float* operator[](std::size_t i) const { return values.data() + i * static_cast<std::size_t>(rows); }
};

using BasisWeights = std::array<float, kMaxUnknowns>;

/// Some reflectances, ready to be fitted to others.
class ReflectanceBasis {
 public:
  explicit ReflectanceBasis(int rows) : rows_(rows) {}
  int size() const { return size_; }
  /// Product of two of them.
  double gram(int i, int j) const { return gram_[i * kMaxUnknowns + j]; }
  /// At most kMaxUnknowns.
  void add(const float* scaled);
  void remove(int index);

  /// Best non-negative weights for `scaled`, joint over the basis. Weights past size() are zero. Returns the residual:
  /// RMS over the rows; infinity where it is no number.
  float fit(const float* scaled, BasisWeights& weights) const;
  /// RMS over the rows of the difference of two mixtures.
  float distance(const float* weights_a, const float* weights_b) const;

 private:
  int rows_, size_ = 0;
  std::vector<float> vectors_;
  std::array<double, std::size_t{kMaxUnknowns} * kMaxUnknowns> gram_{};
};

struct BasisChoice {
  std::vector<std::size_t> chosen;  ///< indices, in order of choice
  float residual = 0;               ///< largest over all vectors
};

/// Chooses among `vectors` until every one is within `tolerance` (RMS over rows of unit RMS) or `max_basis` are chosen:
/// the largest first, then always the one with the largest residual; in the end those that turn out unnecessary are
/// dropped. Starts from the vectors `start`, which are chosen first and never dropped. Ties go to the smaller index.
BasisChoice choose_basis(const ReflectanceVectors& vectors, float tolerance, int max_basis,
                         std::span<const std::size_t> start = {});

/// Reflectances that the paper keeps of each block of texels.
inline constexpr int kPaperPerBlock = 3;
/// Texels across a block of the paper.
inline constexpr int kPaperBlock = 32;

}  // namespace redmap
