// A stream of reflectances brought down to the few thousand that differ: quantised random projections are hashed, and
// of the distinct hashes the smallest are kept (bottom-k sampling, Cohen and Kaplan 2007).
#pragma once

#include <cstdint>
#include <unordered_map>
#include <vector>

#include "analysis/sampling.h"
#include "base/vec.h"

namespace redmap {

/// Hashes sampled reflectances so that equal ones, and nearly only those, have equal keys.
class ReflectanceKeys {
 public:
  explicit ReflectanceKeys(const std::vector<float>& row_scales);
  /// One key a place. `sums` is scratch.
  void compute(const SampledReflectances& sampled, std::vector<std::uint64_t>& keys, LaneVector<float>& sums) const;

  static constexpr int kProjections = 6;
  /// What a value of `row` adds to a sum. A key is hash64(key, sum) over all sums, rounded to whole numbers.
  float factor(int projection, int row) const { return projection_[projection * rows_ + row]; }

 private:
  int rows_;
  std::vector<float> projection_;  ///< kProjections x rows, row scales included
};

/// Where a reflectance was met. Object space, unit normal and tangent.
struct ReflectancePlace {
  Vec3 position, normal, tangent;
  Vec2 uv;
};

/// Distinct reflectances with the place each was met at first. Holds at most `capacity` of them: a uniform random
/// subset, the same for any order of insertion.
class UniqueReflectances {
 public:
  UniqueReflectances(int rows, std::size_t capacity);
  /// `scaled` has `rows` numbers. What is known already, or does not belong to the subset, changes nothing.
  void insert(std::uint64_t key, const float* scaled, const ReflectancePlace& place);
  /// The same where the vector follows through scaled(), after finish().
  void insert(std::uint64_t key, const ReflectancePlace& place);
  /// Whether insert() would store this key.
  bool wants(std::uint64_t key) const { return key <= largest_key_ && !index_.contains(key); }
  /// Drops what exceeds the capacity and orders by key. To be called once, after the last insert().
  void finish();

  std::size_t size() const { return keys_.size(); }
  int rows() const { return rows_; }
  const float* scaled(std::size_t i) const { return &scaled_[i * rows_]; }
  float* scaled(std::size_t i) { return &scaled_[i * rows_]; }
  const ReflectancePlace& place(std::size_t i) const { return places_[i]; }
  std::uint64_t key(std::size_t i) const { return keys_[i]; }
  /// Estimated number of distinct keys that were offered.
  double distinct() const;

 private:
  void keep_smallest();

  int rows_;
  std::size_t capacity_;
  std::uint64_t largest_key_ = ~std::uint64_t{0};  ///< keys above it were dropped, and always will be
  std::unordered_map<std::uint64_t, std::uint32_t> index_;
  std::vector<std::uint64_t> keys_;
  std::vector<float> scaled_;
  std::vector<ReflectancePlace> places_;
};

}  // namespace redmap
