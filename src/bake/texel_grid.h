// The base level of a map while it is being baked: walked tile by tile, in parallel, with results that do not depend on
// the number of threads (paper, section 4.1).
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "bake/bake.h"
#include "map/pyramid.h"
#include "surface/surface.h"

namespace redmap {

/// Tells the caller of a bake how far it is, and takes its wish to stop.
class BakeMonitor {
 public:
  explicit BakeMonitor(BakeProgress callback) : callback_(std::move(callback)) {}
  /// What follows is `name` and takes the bake from where it is to `end`, 0 to 1.
  void begin(std::string_view name, float end);
  void advance(float part_of_stage);
  /// Stops the bake because of `problem`, one line; the first counts. From one thread at a time, as advance().
  void fail(const std::string& problem);
  bool stopped() const { return stopped_; }
  /// Throws BakeInterrupted, or Error with the problem.
  void throw_if_stopped() const;

 private:
  BakeProgress callback_;
  std::string name_, problem_;
  float begin_ = 0, end_ = 0;
  std::atomic<bool> stopped_{false};  ///< set by the sink of a pipeline, read by its producers
};

/// Texels across a tile: the blocks of the paper, and small enough that 4 x 4 points a texel stay in the cache.
inline constexpr int kTile = 32;

class TexelGrid {
 public:
  TexelGrid(const Surface& surface, int size);
  const Surface& surface() const { return surface_; }
  Extent extent() const { return extent_; }
  std::size_t texels() const { return static_cast<std::size_t>(extent_.width) * extent_.height; }
  std::size_t tiles() const { return static_cast<std::size_t>(across_) * down_; }
  TexelRegion tile(std::size_t index) const;
  /// Index in the whole grid of texel `index` of `region`.
  std::size_t texel(TexelRegion region, std::size_t index) const {
    return (region.y + index / region.width) * extent_.width + region.x + index % region.width;
  }

 private:
  const Surface& surface_;
  Extent extent_;
  int across_ = 0, down_ = 0;
};

/// Offsets of n x n points in a texel.
std::vector<Vec2> sub_sample_offsets(int n);

/// Points evaluated together: few enough for their sampled reflectances to stay in the second-level cache.
inline constexpr std::size_t kBatch = 512;
/// Copies points [begin, end) of `points`; padding repeats the last.
void copy_points(const SurfacePoints& points, std::size_t begin, std::size_t end, SurfacePoints& out);

/// Texels whose 3 x 3 neighbourhood is not alike: some covered and some not, or values that `differ`.
using ValuesDiffer = std::function<bool(const float* a, const float* b)>;
std::vector<std::uint8_t> find_differing_texels(const BaseLevel& base, const ValuesDiffer& differ);

/// Values of `points`, `channels` each, into `out`. `texel` says which texel of the base level each lies under. Called
/// in parallel; `slot` is exclusive, as in parallel_pipeline().
using EvaluatePoints =
    std::function<void(const SurfacePoints& points, std::span<const std::size_t> texel, std::size_t slot, float* out)>;
/// After each tile, in order, one at a time.
using TileDone = std::function<void(std::size_t slot)>;

/// Replaces the `wanted` texels of `base` by the average of `sub_samples`^2 points each, and their coverage by the part
/// of these that lie on the surface. Throws BakeInterrupted, or Error if `done`
/// has failed the monitor.
void average_texels(const TexelGrid& grid, std::span<const std::uint8_t> wanted, int sub_samples,
                    const EvaluatePoints& evaluate, const TileDone& done, BakeMonitor& monitor, BaseLevel& base);

}  // namespace redmap
