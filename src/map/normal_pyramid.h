// Distributions of shading normals per texel, on every level of a pyramid (paper, section 4.5). The paper keeps one
// mean and covariance; we keep up to two Gaussians a texel, each with the weights of the basis that go with it, since
// dull grooves and shiny ridges are not one distribution (docs/normals.md).
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "map/normal_mixtures.h"
#include "map/pyramid.h"

namespace redmap {

/// A Gaussian of unit normals (x, y, sqrt(1 - x^2 - y^2)) in the interpolated shading frame of their texel.
struct NormalGaussian {
  float x = 0, y = 0;            ///< mean
  float xx = 0, xy = 0, yy = 0;  ///< covariance
};

/// Six bytes: mean in twelve bits an axis, square roots of the covariance's eigenvalues on a logarithmic scale, and the
/// angle of the larger. Zero means, and zero covariances, are exact.
struct PackedNormals {
  std::array<std::uint8_t, 6> bytes{};
};
PackedNormals pack(const NormalGaussian& normals);

/// Steps of a mean, either side of zero.
inline constexpr float kPackedMeanSteps = 2047;
/// What the other bytes stand for.
struct PackedTables {
  std::array<float, 256> variance, cosine, sine;  ///< of twice the angle
  PackedTables();
};
extern const PackedTables kPackedTables;

inline NormalGaussian unpack(const PackedNormals& packed) {
  const auto& b = packed.bytes;
  const int x = b[0] | (b[1] & 15) << 8, y = b[1] >> 4 | b[2] << 4;
  const float half_sum = 0.5f * (kPackedTables.variance[b[3]] + kPackedTables.variance[b[4]]);
  const float half_difference = 0.5f * (kPackedTables.variance[b[3]] - kPackedTables.variance[b[4]]);
  const float along = half_difference * kPackedTables.cosine[b[5]];
  return {static_cast<float>(x - 2048) * (1 / kPackedMeanSteps), static_cast<float>(y - 2048) * (1 / kPackedMeanSteps),
          half_sum + along, half_difference * kPackedTables.sine[b[5]], half_sum - along};
}

class FootprintTexels;
struct GatherPlan;

/// How the mean normal changes across a texel of the base, along its columns and rows.
struct NormalSlope {
  Vec2 along_x, along_y;
};

class NormalPyramid {
 public:
  /// Gaussians a texel: one at the base, this many on every other level.
  static constexpr int kGaussians = 2;
  /// What build() takes a texel of the base from: means of x, y, x^2, x y, y^2 over it.
  static constexpr int kMoments = 5;

  NormalPyramid() = default;
  /// `moments` as kMoments says, of the extent of `weights`' base, and the weights that go with them.
  NormalPyramid(const BaseLevel& moments, const WeightPyramid& weights);

  bool empty() const { return levels_.empty(); }
  int levels() const { return static_cast<int>(levels_.size()); }
  int basis() const { return basis_; }
  Extent extent(int level) const { return levels_[level].extent; }
  std::size_t bytes() const { return data_.size(); }
  /// Bytes of a texel on a level. Each of its Gaussians has 6 of PackedNormals; beyond the base, one more for its share
  /// of the texel and one for each weight, in parts of the scales of the weights.
  int texel_bytes(int level) const { return level == 0 ? 6 : kGaussians * (7 + basis_); }
  std::span<std::uint8_t> row(int level, int y);
  std::span<const std::uint8_t> row(int level, int y) const;
  /// All zero, of the levels and basis of `weights`, to be filled through row(): for readers.
  explicit NormalPyramid(const WeightPyramid& weights);

  /// Appends, hit by hit, the distributions under `footprints`: every texel that a footprint overlaps, by the area of
  /// the overlap and its coverage, on the level where about `texels` to twice as many lie across it. `weights` is the
  /// pyramid that this one was built with.
  void gather(std::span<const Footprint> footprints, const WeightPyramid& weights, float texels,
              NormalMixtures& out) const;

 private:
  struct Level {
    Extent extent;
    std::size_t offset = 0;
  };
  class Unrounded;
  Unrounded store_base(const BaseLevel& moments, const WeightPyramid& weights);
  Unrounded store_level(int level, const Unrounded& fine);
  /// The distributions of one level under a footprint go behind the `count` that are there; their shares sum to `part`.
  /// False if nothing is covered.
  bool gather_level(int level, const Footprint& footprint, const WeightPyramid& weights, float part,
                    std::uint32_t& count, NormalMixtures& out) const;
  void gather_one(const Footprint& footprint, bool usable, const GatherPlan& plan, const WeightPyramid& weights,
                  NormalMixtures& out) const;
  NormalSlope slope_at(const WeightPyramid& weights, int x, int y) const;
  void prefetch(int level, const FootprintTexels& texels, const WeightPyramid& weights) const;
  std::uint8_t* texel(int level, int x, int y) {
    const Level& l = levels_[level];
    return data_.data() + l.offset + (static_cast<std::size_t>(y) * l.extent.width + x) * texel_bytes(level);
  }
  const std::uint8_t* texel(int level, int x, int y) const {
    return const_cast<NormalPyramid*>(this)->texel(level, x, y);
  }

  int basis_ = 0;
  std::vector<Level> levels_;
  std::vector<std::uint8_t> data_;
};

}  // namespace redmap
