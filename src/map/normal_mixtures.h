// The normals under some footprints, as mixtures of Gaussians that each carry their own weights: what a lookup in a map
// with normals gives (paper, section 4.5, with normals and weights tied together).
#pragma once

#include <cstdint>
#include <vector>

#include "base/surface_points.h"
#include "map/tangent_gather.h"

namespace redmap {

/// Gaussian distributions of unit normals in the interpolated shading frame of their place, and the weights of the
/// basis reflectances that go with each. Those of hit i are [first[i], first[i + 1]).
struct NormalMixtures {
  std::vector<std::uint32_t> first;
  // Vectors may be longer than first.back(); what lies beyond is not there.
  LaneVector<float> x, y, xx, xy, yy;      ///< mean and covariance of the normal's x and y
  std::vector<LaneVector<float>> weights;  ///< [basis][distribution]; over a hit they sum to the basis' weight
  std::vector<GatheredTurns> turns;        ///< of the grain under each hit; empty: the reflectances have none
  bool one_a_hit = false;                  ///< first[i] = i, and all is padded with zeros

  std::size_t hits() const { return first.size() - 1; }
  /// One distribution a hit: the normal (0, 0, 1) itself.
  static NormalMixtures one_each(std::size_t hits, std::vector<LaneVector<float>> basis_weights);
  /// No hit yet.
  static NormalMixtures none(std::size_t basis);
  /// Lengthens the vectors to `count` distributions at least.
  void make_room(std::size_t count);
};

}  // namespace redmap
