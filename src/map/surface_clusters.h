// Mean weights of patches of the surface, patches of patches, and so on up to the whole: what a map is looked up in
// where the texels of its atlas would span several charts. Patches are near each other on the surface, charts in uv
// need not be. The hierarchy is that of light cuts (Walter et al. 2005), by position and normal.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "base/vec.h"
#include "map/pyramid.h"

namespace redmap {

/// The area under a pixel: a parallelogram on the tangent plane, object space. `normal` (unit) on the side it is seen
/// from.
struct SurfaceFootprint {
  Vec3 position, normal;
  Vec3 axis_x, axis_y;  ///< change of position over the footprint, from side to side
};

/// Where the area of a patch is: means over it.
struct ClusterPlace {
  Vec3 position, normal;  ///< the normal gets shorter the more the patch is curved
  float radius = 0;       ///< from `position` to the farthest place of the patch, at most
  float variance = 0;     ///< mean squared distance from `position`
};

/// Part that clusters have in a lookup, 0 (the atlas alone) to 1: over footprints whose shorter side is 8 to 16 texels
/// of the base level. From there on taps take in texels of other charts.
float cluster_part(const Footprint& footprint, Extent base_extent);

class SurfaceClusters {
 public:
  SurfaceClusters() = default;
  /// Leaves of equal area in the order of a balanced tree: `channels` weights each. Throws Error unless their number is
  /// a power of two, and all is finite.
  SurfaceClusters(std::vector<ClusterPlace> leaves, std::vector<float> leaf_weights, int channels);
  /// From small cells of equal area, in any order; `leaves` is a power of two that divides their number.
  static SurfaceClusters build(std::span<const ClusterPlace> cells, std::span<const float> weights, int channels,
                               std::size_t leaves);

  bool empty() const { return leaves_ == 0; }
  int channels() const { return channels_; }
  std::size_t leaves() const { return leaves_; }
  /// Of a node: 1 is the root, 2 i and 2 i + 1 are below i, the last half are the leaves.
  ClusterPlace place(std::size_t node) const;
  std::vector<float> weights(std::size_t node) const;
  ClusterPlace leaf(std::size_t i) const { return place(leaves() + i); }
  std::vector<float> leaf_weights(std::size_t i) const { return weights(leaves() + i); }
  std::size_t bytes() const { return blocks_.size() * sizeof(float); }

  /// Mean weights of what is under the footprint and faces its side, into the first channels of `weights`. False if
  /// nothing is.
  bool lookup(const SurfaceFootprint& footprint, std::array<float, kMaxChannels>& weights) const;

 private:
  static constexpr int kPlaceFloats = 8;
  /// Of component `c` of the place of a node, or of weight c - kPlaceFloats.
  std::size_t index(std::size_t node, int c) const {
    return ((node / kLanes) * (kPlaceFloats + channels_) + c) * kLanes + node % kLanes;
  }
  void set(std::size_t node, const ClusterPlace& place);

  int channels_ = 0;
  std::size_t leaves_ = 0;
  LaneVector<float> blocks_;  ///< of eight nodes: each component of their places and weights side by side
};

}  // namespace redmap
