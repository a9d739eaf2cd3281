// Pyramids of interleaved texels and the anisotropic, variance-matched lookup (paper, sections 4.4 and 5.3; departures
// in docs/lookup.md).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

#include "base/extent.h"
#include "base/surface_points.h"
#include "map/footprint.h"

namespace redmap {

/// Most channels a pyramid can have, coverage not counted.
inline constexpr int kMaxChannels = 16;

/// Lookups whose memory is asked for together: their first texels fit the first-level cache several times over.
inline constexpr std::size_t kLookupBatch = 32;

/// Result of a lookup: filtered channels, already divided by the filtered coverage. Channels past the pyramid's are
/// zero.
struct FilteredTexel {
  float coverage = 0;
  alignas(32) std::array<float, kMaxChannels> channel{};
};

/// How a footprint is filtered.
enum class LookupFilter {
  kVarianceMatched,  ///< anisotropic: bilinear taps along the major axis, levels mixed by variance
  kEnclosingSquare,  ///< the paper's: trilinear at the size of the enclosing square
};

/// Axes of a footprint in texels of `extent`: the singular values of its Jacobian.
struct FootprintAxes {
  float major = 0, minor = 0;
  Vec2 major_direction_uv;  ///< of the major axis, scaled so that it spans the footprint once in uv
};
FootprintAxes footprint_axes(const Footprint& footprint, Extent extent);

/// The bilinear taps that stand for a footprint: tap i at `first_uv + i * step_uv`, each on `level` with part
/// 1 - coarse_part and on level + 1 with `coarse_part`.
struct LookupPlan {
  Vec2 first_uv, step_uv;
  int taps = 1;
  int level = 0;
  float coarse_part = 0;
};
/// `extent` is that of level 0 of a pyramid of `levels` levels. Never names a level that is not there; a footprint that
/// is not finite gets the centre of the coarsest level.
LookupPlan plan_lookup(const Footprint& footprint, Extent extent, int levels, LookupFilter filter);
/// The same for many footprints, eight at a time. `out` has the size of `footprints`.
void plan_lookups(std::span<const Footprint> footprints, Extent extent, int levels, LookupFilter filter,
                  std::span<LookupPlan> out);

/// What a pyramid is built from: row-major texels, channels interleaved, coverage 0 to 1. Values where coverage is nil
/// do not matter.
struct BaseLevel {
  Extent extent;
  int channels = 0;
  bool wraps_u = false;
  std::vector<float> values;    ///< extent.width * extent.height * channels, all finite
  std::vector<float> coverage;  ///< extent.width * extent.height

  BaseLevel() = default;
  BaseLevel(Extent size, int channel_count, bool wraps);
};

/// Levels of texels, each a coverage and `channels()` values. Component is std::uint8_t (value = byte / 255 * scale of
/// the channel) or float. Level 0 is the base; each level halves the one below (rounding down, at least 1) by a
/// coverage-weighted box, until 1 x 1. Values are stored as they are, not premultiplied: coverage multiplies at the tap
/// and is divided out after filtering. Where coverage is nil the values are pulled from the coarser levels.
template <typename Component>
class Pyramid {
 public:
  Pyramid() = default;
  /// Bytes: the scale of a channel is its largest covered value in the base, negative values become zero. Throws Error
  /// on an empty extent, a channel count outside [1, kMaxChannels], or vectors that do not fit them.
  explicit Pyramid(const BaseLevel& base);
  /// All zero, to be filled through row() and finished by pad_rows(): for readers. `scales` are as scales() says.
  Pyramid(Extent base, int channels, bool wraps_u, std::span<const float> scales);

  int channels() const { return channels_; }
  int levels() const { return static_cast<int>(levels_.size()); }
  Extent extent(int level) const { return levels_[level].extent; }
  bool wraps_u() const { return wraps_u_; }
  bool empty() const { return levels_.empty(); }
  /// Value of a full byte, a channel; 1 for floats.
  std::span<const float> scales() const { return {scales_.data(), static_cast<std::size_t>(channels_)}; }
  std::size_t bytes() const { return data_.size() * sizeof(Component); }

  float coverage(int level, int x, int y) const { return kComponentStep * static_cast<float>(texel(level, x, y)[0]); }
  /// Stored value of a channel, not multiplied by coverage.
  float value(int level, int x, int y, int channel) const {
    return kComponentStep * scales_[channel] * static_cast<float>(texel(level, x, y)[1 + channel]);
  }

  /// The texels of a row: `texel_stride()` components each, coverage first, then the channels, then padding.
  std::span<Component> row(int level, int y);
  std::span<const Component> row(int level, int y) const;
  int texel_stride() const { return texel_stride_; }
  /// Copies what lies beyond the right edge: to be called once after row() was written to.
  void pad_rows();

  /// The map filtered over `footprint`. u wraps where the surface does, else it clamps, as v always does. Where nothing
  /// is covered, `coverage` is zero and the channels are those that were pulled in.
  FilteredTexel lookup(const Footprint& footprint, LookupFilter how = LookupFilter::kVarianceMatched) const;
  /// The same for many footprints at once, which waits less for memory. `out` has the size of `footprints`.
  void lookup(std::span<const Footprint> footprints, LookupFilter how, std::span<FilteredTexel> out) const;

 private:
  struct Level {
    Extent extent;
    std::size_t offset = 0;      ///< of texel (0, 0), in components
    std::size_t row_stride = 0;  ///< in components: one texel more than the width
  };
  struct TapBlock;
  struct Sum;

  static constexpr float kComponentStep = std::is_same_v<Component, float> ? 1.0f : 1.0f / 255.0f;

  const Component* texel(int level, int x, int y) const {
    const Level& l = levels_[level];
    return data_.data() + l.offset + y * l.row_stride + static_cast<std::size_t>(x) * texel_stride_;
  }
  Component* texel(int level, int x, int y) { return const_cast<Component*>(std::as_const(*this).texel(level, x, y)); }
  void allocate(Extent base, int channels, bool wraps_u);
  void store(int level, const BaseLevel& texels);
  void fill_uncovered(int level);
  void place_taps(const LookupPlan& plan, int first, const Level& fine, const Level& coarse, TapBlock& block) const;
  template <int kChunks, bool kUseCoverage>
  void add_tap(const Level& level, int lane, TapBlock& block, Sum& sum) const;
  template <int kChunks, bool kUseCoverage>
  FilteredTexel gather(const LookupPlan& plan) const;
  FilteredTexel filter(const LookupPlan& plan) const;
  void prefetch(const LookupPlan& plan) const;

  int channels_ = 0, texel_stride_ = 0;
  bool wraps_u_ = false;
  std::vector<Level> levels_;
  alignas(32) std::array<float, kMaxChannels> scales_{};  ///< zero past the channels: clears what lanes read beyond
  LaneVector<Component> data_;
};

using WeightPyramid = Pyramid<std::uint8_t>;

}  // namespace redmap
