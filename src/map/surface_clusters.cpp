#include "map/surface_clusters.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numeric>

#include "base/error.h"
#include "base/lanes_math.h"
#include "base/parallel.h"
#include "map/lookup_limits.h"

namespace redmap {
namespace {

using lanes::Bool;
using lanes::Float;
using lanes::Int;

/// Two patches of equal area as one.
ClusterPlace join(const ClusterPlace& a, const ClusterPlace& b) {
  const Vec3 apart = b.position - a.position;
  const float half = 0.5f * length(apart);
  return {(a.position + b.position) * 0.5f, (a.normal + b.normal) * 0.5f, half + std::max(a.radius, b.radius),
          0.5f * (a.variance + b.variance) + half * half};
}

/// Orders cells so that each half, quarter, eighth, ... is a patch: always cut across the longest side.
class CellSorter {
 public:
  CellSorter(std::span<const ClusterPlace> cells, std::vector<std::uint32_t>& order) : cells_(cells), order_(order) {}

  void sort(std::size_t begin, std::size_t end, std::size_t parts) {
    if (parts < 2) return;
    const int axis = longest_axis(begin, end);
    const std::size_t middle = begin + (end - begin) / 2;
    std::nth_element(order_.begin() + begin, order_.begin() + middle, order_.begin() + end,
                     [&](std::uint32_t a, std::uint32_t b) {
                       const float ka = key(a, axis), kb = key(b, axis);
                       return ka != kb ? ka < kb : a < b;
                     });
    const auto sort_half = [&](std::size_t half) {
      half == 0 ? sort(begin, middle, parts / 2) : sort(middle, end, parts / 2);
    };
    if (end - begin > kCellsWorthAThread)
      parallel_for(2, sort_half);
    else
      sort_half(0), sort_half(1);
  }

 private:
  /// Handing on fewer costs more than it gains.
  static constexpr std::size_t kCellsWorthAThread = 1 << 12;

  /// Axes 0 to 2 are those of the position, 3 to 5 those of the normal.
  float key(std::uint32_t cell, int axis) const {
    return axis < 3 ? cells_[cell].position[axis] : cells_[cell].normal[axis - 3];
  }

  int longest_axis(std::size_t begin, std::size_t end) const {
    float range[6];
    for (int axis = 0; axis < 6; ++axis) {
      float low = key(order_[begin], axis), high = low;
      for (std::size_t i = begin; i < end; ++i) {
        low = std::min(low, key(order_[i], axis));
        high = std::max(high, key(order_[i], axis));
      }
      range[axis] = high - low;
    }
    // Normals that are 60 degrees apart and more keep front and back from being mixed: they come first.
    const auto normal = std::max_element(range + 3, range + 6);
    if (*normal > 1) return static_cast<int>(normal - range);
    return static_cast<int>(std::max_element(range, range + 3) - range);
  }

  std::span<const ClusterPlace> cells_;
  std::vector<std::uint32_t>& order_;
};

struct Vec3Lanes {
  Float x, y, z;
};
Float dot(const Vec3Lanes& a, const Vec3Lanes& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
Float dot(Vec3 a, const Vec3Lanes& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }

/// Eight ClusterPlace.
struct PlaceLanes {
  Vec3Lanes position, normal;
  Float radius, variance;
  explicit PlaceLanes(const float* block)
      : position{at(block, 0), at(block, 1), at(block, 2)},
        normal{at(block, 3), at(block, 4), at(block, 5)},
        radius(at(block, 6)),
        variance(at(block, 7)) {}
  static Float at(const float* block, int component) { return lanes::load(block + component * kLanes); }
};

/// Lanes [first, first + count).
Bool some_lanes(std::size_t first, std::size_t count) {
  const Int lane = lanes::IntRegister{0, 1, 2, 3, 4, 5, 6, 7};
  return lane >= Int(static_cast<int>(first)) && lane < Int(static_cast<int>(first + count));
}

/// How much of a place counts: squared distances in units of the footprint's standard deviation, and the side.
class FootprintKernel {
 public:
  explicit FootprintKernel(const SurfaceFootprint& f) : centre_(f.position), normal_(f.normal) {
    // A box has variance width^2 / 12. Along the normal it is as wide as its longer side: what is farther away is
    // another part of the surface.
    const float longer = std::max(dot(f.axis_x, f.axis_x), dot(f.axis_y, f.axis_y));
    float m[3][3];
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j)
        m[i][j] = (f.axis_x[i] * f.axis_x[j] + f.axis_y[i] * f.axis_y[j] + f.normal[i] * f.normal[j] * longer +
                   (i == j ? kClusterRound * longer : 0)) /
                  12;
    reach_ = std::sqrt(kClusterSupport * (longer + dot(f.axis_x, f.axis_x) + dot(f.axis_y, f.axis_y)) / 12);
    const float area = length(cross(f.axis_x, f.axis_y));
    smallest_variance_ = longer > 0 ? std::max(area * area / longer, kClusterRound * longer) / 12 : 0;
    const Vec3 rows[3] = {{m[0][0], m[0][1], m[0][2]}, {m[1][0], m[1][1], m[1][2]}, {m[2][0], m[2][1], m[2][2]}};
    const float determinant = dot(rows[0], cross(rows[1], rows[2]));
    for (int i = 0; i < 3; ++i) inverse_[i] = cross(rows[(i + 1) % 3], rows[(i + 2) % 3]) / determinant;
  }

  /// How much of each of eight places counts, and which of them have to be cut into smaller ones first.
  struct Counted {
    Float part;
    Bool large;
  };
  Counted count(const PlaceLanes& place, Bool are_leaves) const {
    const Vec3Lanes away{place.position.x - centre_.x, place.position.y - centre_.y, place.position.z - centre_.z};
    const Float reach = place.radius + reach_;
    const Bool reached = dot(away, away) < reach * reach;
    // A tenth of the variance blurs the footprint by 5 %; half a radian of curvature.
    const Bool small =
        are_leaves || (place.variance < 0.1f * smallest_variance_ && dot(place.normal, place.normal) > 0.9f);
    // Flat in the middle, nil beyond the support; and a soft step from one side of the surface to the other.
    const Vec3Lanes scaled{dot(inverse_[0], away), dot(inverse_[1], away), dot(inverse_[2], away)};
    const Float near = lanes::max(0.0f, 1.0f - dot(away, scaled) * (1 / kClusterSupport));
    const Float facing = lanes::clamp(kClusterSideSlope * dot(normal_, place.normal), 0.0f, 1.0f);
    return {lanes::select(reached && small, near * facing, 0.0f), reached && !small};
  }
  bool is_usable() const { return std::isfinite(inverse_[0].x + inverse_[1].y + inverse_[2].z); }

 private:
  Vec3 centre_, normal_, inverse_[3];
  float reach_, smallest_variance_;
};

}  // namespace

float cluster_part(const Footprint& footprint, Extent base_extent) {
  // As in the lookup in the atlas, long footprints count as wider than they are.
  // The shorter side bounds the minor axis, the diagonal the major: most footprints are decided there.
  const float columns = static_cast<float>(base_extent.width), rows = static_cast<float>(base_extent.height);
  const Vec2 x{footprint.duv_dx.x * columns, footprint.duv_dx.y * rows};
  const Vec2 y{footprint.duv_dy.x * columns, footprint.duv_dy.y * rows};
  constexpr float kLongest = kClustersBegin * kLookupAnisotropy;
  if (std::min(dot(x, x), dot(y, y)) <= kClustersBegin * kClustersBegin && dot(x, x) + dot(y, y) <= kLongest * kLongest)
    return 0;
  const FootprintAxes axes = footprint_axes(footprint, base_extent);
  const float width = std::max(axes.minor, axes.major / kLookupAnisotropy);
  return width > kClustersBegin ? std::min(1.0f, std::log2(width / kClustersBegin)) : 0.0f;
}

SurfaceClusters::SurfaceClusters(std::vector<ClusterPlace> leaves, std::vector<float> leaf_weights, int channels)
    : channels_(channels) {
  const std::size_t count = leaves.size();
  if (!std::has_single_bit(count) || leaf_weights.size() != count * channels)
    throw Error("clusters: expected a power of two of leaves with {} weights each, found {} leaves, {} weights",
                channels, count, leaf_weights.size());
  for (const ClusterPlace& p : leaves)
    if (!std::isfinite(dot(p.position, p.position) + dot(p.normal, p.normal) + p.radius + p.variance))
      throw Error("clusters: expected finite places");
  for (const float w : leaf_weights)
    if (!std::isfinite(w)) throw Error("clusters: expected finite weights");

  leaves_ = count;
  blocks_.resize(padded(2 * count) * (kPlaceFloats + channels));
  for (std::size_t leaf = 0; leaf < count; ++leaf) {
    set(count + leaf, leaves[leaf]);
    for (int c = 0; c < channels; ++c)
      blocks_[index(count + leaf, kPlaceFloats + c)] = leaf_weights[leaf * channels + c];
  }
  for (std::size_t node = count; node-- > 1;) {
    set(node, join(place(2 * node), place(2 * node + 1)));
    for (int c = kPlaceFloats; c < kPlaceFloats + channels; ++c)
      blocks_[index(node, c)] = 0.5f * (blocks_[index(2 * node, c)] + blocks_[index(2 * node + 1, c)]);
  }
}

void SurfaceClusters::set(std::size_t node, const ClusterPlace& p) {
  const float components[kPlaceFloats] = {p.position.x, p.position.y, p.position.z, p.normal.x,
                                          p.normal.y,   p.normal.z,   p.radius,     p.variance};
  for (int c = 0; c < kPlaceFloats; ++c) blocks_[index(node, c)] = components[c];
}

ClusterPlace SurfaceClusters::place(std::size_t node) const {
  const auto at = [&](int c) { return blocks_[index(node, c)]; };
  return {{at(0), at(1), at(2)}, {at(3), at(4), at(5)}, at(6), at(7)};
}

std::vector<float> SurfaceClusters::weights(std::size_t node) const {
  std::vector<float> weights(channels_);
  for (int c = 0; c < channels_; ++c) weights[c] = blocks_[index(node, kPlaceFloats + c)];
  return weights;
}

SurfaceClusters SurfaceClusters::build(std::span<const ClusterPlace> cells, std::span<const float> weights,
                                       int channels, std::size_t leaves) {
  std::vector<std::uint32_t> order(cells.size());
  std::iota(order.begin(), order.end(), 0u);
  CellSorter(cells, order).sort(0, cells.size(), leaves);
  const std::size_t share = cells.size() / leaves;
  std::vector<ClusterPlace> places(leaves);
  std::vector<float> means(leaves * channels);
  for (std::size_t leaf = 0; leaf < leaves; ++leaf) {
    const std::span<const std::uint32_t> members(&order[leaf * share], share);
    ClusterPlace& place = places[leaf];
    for (const std::uint32_t cell : members) {
      place.position += cells[cell].position, place.normal += cells[cell].normal;
      for (int c = 0; c < channels; ++c) means[leaf * channels + c] += weights[cell * channels + c];
    }
    const float part = 1 / static_cast<float>(share);
    place.position = place.position * part, place.normal = place.normal * part;
    for (int c = 0; c < channels; ++c) means[leaf * channels + c] *= part;
    for (const std::uint32_t cell : members) {
      const Vec3 away = cells[cell].position - place.position;
      place.variance += part * (dot(away, away) + cells[cell].variance);
      place.radius = std::max(place.radius, length(away) + cells[cell].radius);
    }
  }
  return SurfaceClusters(std::move(places), std::move(means), channels);
}

bool SurfaceClusters::lookup(const SurfaceFootprint& footprint, std::array<float, kMaxChannels>& weights) const {
  const FootprintKernel kernel(footprint);
  if (empty() || !kernel.is_usable()) return false;
  Float total = 0.0f;
  std::array<Float, kMaxChannels> sums;
  std::fill_n(sums.begin(), channels_, 0.0f);
  // What is below a node is looked at three levels down, where its eight patches lie side by side. Seven of each eight
  // wait: enough for 2^33 leaves.
  constexpr int kStep = 3;
  std::size_t waiting[80] = {1};
  const int last = static_cast<int>(std::bit_width(leaves()));
  for (int count = 1; count > 0;) {
    const std::size_t above = waiting[--count];
    const int down = std::min(kStep, last - static_cast<int>(std::bit_width(above)));
    const std::size_t first = above << down;
    const float* block = blocks_.data() + index(first - first % kLanes, 0);
    const Bool there = some_lanes(first % kLanes, std::size_t{1} << down);
    const FootprintKernel::Counted counted = kernel.count(PlaceLanes(block), first >= leaves());
    // Patches on one level have equal areas: twice that of the level below.
    const Float area = std::ldexp(1.0f, -static_cast<int>(std::bit_width(first)));
    const Float part = lanes::select(there, counted.part * area, 0.0f);
    total += part;
    for (int c = 0; c < channels_; ++c) sums[c] += part * lanes::load(block + (kPlaceFloats + c) * kLanes);
    const Bool large = there && counted.large;
    for (std::size_t lane = kLanes; lane-- > 0;)
      if (large.v[lane]) waiting[count++] = first - first % kLanes + lane;
  }
  const float whole = lanes::sum(total);
  if (!(whole > 0)) return false;
  for (int c = 0; c < channels_; ++c) weights[c] = lanes::sum(sums[c]) / whole;
  return true;
}

}  // namespace redmap
