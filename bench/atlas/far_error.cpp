#include "atlas/far_error.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "bake/surface_cells.h"
#include "bake/texel_grid.h"
#include "base/parallel.h"
#include "base/random.h"
#include "map/pyramid.h"
#include "render/hit_footprint.h"
#include "render/seam_lookup.h"
#include "surface/mesh.h"

namespace redmap::bench {
namespace {

/// Noise cells across the object's longest side: like the library's noise shader on a sphere.
constexpr float kNoiseCells = 28;

/// Footprints a level, half of them beside seams.
constexpr std::size_t kFootprints = 400;
constexpr float kSeamTexels = 2;

/// Up to 8 texels wide: clusters have no say (cluster_part()).
constexpr int kNearLevels = 3;

/// Points under a footprint of a reference, about; triangles larger than the footprint get as many for their part of
/// it.
constexpr double kPointsPerFootprint = 1024;

/// Trilinear value noise, 0 to 1.
float solid_noise(Vec3 p) {
  const Vec3 cell{std::floor(p.x), std::floor(p.y), std::floor(p.z)}, f = p - cell;
  float sum = 0;
  for (int corner = 0; corner < 8; ++corner) {
    const int x = corner & 1, y = corner >> 1 & 1, z = corner >> 2;
    const auto at = [](float base, int step) { return static_cast<std::uint64_t>(static_cast<int>(base) + step); };
    const float value = unit_float(hash64(at(cell.x, x), at(cell.y, y), at(cell.z, z)));
    sum += (x ? f.x : 1 - f.x) * (y ? f.y : 1 - f.y) * (z ? f.z : 1 - f.z) * value;
  }
  return sum;
}

/// Solid noise, and what it is on average under a footprint on the surface.
class NoiseOnMesh {
 public:
  explicit NoiseOnMesh(const Surface& surface) : surface_(surface), mesh_(*surface.mesh()) {
    const Vec3 extent = surface.upper() - surface.lower();
    frequency_ = kNoiseCells / std::max({extent.x, extent.y, extent.z});
    for (std::size_t t = 0; t < mesh_.triangles.size(); ++t) areas_.push_back(total_area_ += triangle_area(t));
  }

  float at(Vec3 position) const { return solid_noise((position - surface_.lower()) * frequency_); }

  /// A place evenly distributed over the surface.
  HitCoordinates random_place(Random& random) const {
    const double area = total_area_ * random.next_float();
    const std::size_t t =
        std::min<std::size_t>(std::upper_bound(areas_.begin(), areas_.end(), area) - areas_.begin(), areas_.size() - 1);
    Vec2 where{random.next_float(), random.next_float()};
    if (where.x + where.y > 1) where = {1 - where.x, 1 - where.y};
    return {static_cast<std::uint32_t>(t), where};
  }

  float area_average(const SurfaceHit& hit, float width) const {
    const Frame frame = make_frame(hit.geometric_normal, hit.dp_du);
    double sum = 0, weight = 0;
    for (std::size_t t = 0; t < mesh_.triangles.size(); ++t) {
      if (dot(doubled_normal(t), hit.normal) <= 0 || !reaches(t, frame, hit.position, width)) continue;
      add_triangle(t, frame, hit.position, width, sum, weight);
    }
    return weight > 0 ? static_cast<float>(sum / weight) : at(hit.position);
  }

 private:
  Vec3 corner(std::size_t t, int k) const { return mesh_.positions[mesh_.triangles[t][k]]; }
  Vec3 doubled_normal(std::size_t t) const { return cross(corner(t, 1) - corner(t, 0), corner(t, 2) - corner(t, 0)); }
  double triangle_area(std::size_t t) const { return 0.5 * length(doubled_normal(t)); }

  bool reaches(std::size_t t, const Frame& frame, Vec3 centre, float width) const {
    Vec3 low{1e30f, 1e30f, 1e30f}, high = -low;
    for (int k = 0; k < 3; ++k) {
      const Vec3 local = frame.to_local(corner(t, k) - centre);
      for (int axis = 0; axis < 3; ++axis)
        low[axis] = std::min(low[axis], local[axis]), high[axis] = std::max(high[axis], local[axis]);
    }
    for (int axis = 0; axis < 3; ++axis)
      if (low[axis] > width / 2 || high[axis] < -width / 2) return false;
    return true;
  }

  void add_triangle(std::size_t t, const Frame& frame, Vec3 centre, float width, double& sum, double& weight) const {
    const double area = triangle_area(t);
    const int n = std::clamp(static_cast<int>(std::sqrt(area * kPointsPerFootprint) / width) + 1, 2, 256);
    const Vec3 e1 = corner(t, 1) - corner(t, 0), e2 = corner(t, 2) - corner(t, 0);
    for (int j = 0; j < n; ++j)
      for (int i = 0; i < n; ++i) {
        float u = (static_cast<float>(i) + 0.5f) / static_cast<float>(n);
        float v = (static_cast<float>(j) + 0.5f) / static_cast<float>(n);
        if (u + v > 1) u = 1 - u, v = 1 - v;
        const Vec3 p = corner(t, 0) + e1 * u + e2 * v, local = frame.to_local(p - centre);
        if (std::max({std::abs(local.x), std::abs(local.y), std::abs(local.z)}) > width / 2) continue;
        sum += area / (n * n) * at(p), weight += area / (n * n);
      }
  }

  const Surface& surface_;
  const TriangleMesh& mesh_;
  float frequency_ = 1;
  double total_area_ = 0;
  std::vector<double> areas_;  ///< cumulated
};

/// Its map on one atlas.
class NoiseMap {
 public:
  NoiseMap(const NoiseOnMesh& noise, const Surface& surface, int size) : surface_(surface) {
    const TexelGrid grid(surface_, size);
    BaseLevel base(grid.extent(), 1, surface_.wraps_u());
    BakeMonitor monitor(nullptr);
    const std::vector<std::uint8_t> all(grid.texels(), 1);
    average_texels(
        grid, all, 4,
        [&](const SurfacePoints& points, std::span<const std::size_t>, std::size_t, float* out) {
          for (std::size_t i = 0; i < points.size(); ++i) out[i] = noise.at(points.position.get(i));
        },
        nullptr, monitor, base);
    weights_ = WeightPyramid(base);
    clusters_ = build_clusters(surface_, weights_);
  }

  /// Width of a texel on the surface, on average.
  float texel() const {
    const Extent extent = weights_.extent(0);
    return static_cast<float>(std::sqrt(surface_.area() / (surface_.uv_area() * extent.width * extent.height)));
  }

  SurfaceHit hit(const HitCoordinates& where) const {
    SurfaceHit hit;
    surface_.complete({&where, 1}, {&hit, 1});
    return hit;
  }

  /// Whether a texel within kSeamTexels is not covered whole.
  bool is_at_seam(Vec2 uv) const {
    const Extent extent = weights_.extent(0);
    const float x = uv.x * static_cast<float>(extent.width), y = uv.y * static_cast<float>(extent.height);
    for (int j = static_cast<int>(y - kSeamTexels); j <= static_cast<int>(y + kSeamTexels); ++j)
      for (int i = static_cast<int>(x - kSeamTexels); i <= static_cast<int>(x + kSeamTexels); ++i)
        if (weights_.coverage(0, std::clamp(i, 0, extent.width - 1), std::clamp(j, 0, extent.height - 1)) < 1)
          return true;
    return false;
  }

  float look_up(const SurfaceHit& hit, float width) const {
    const Frame frame = make_frame(hit.geometric_normal, hit.dp_du);
    const Footprint footprint = round_footprint(hit, width);
    std::uint64_t lookups = 0;
    float value = mend_at_seams(weights_, *surface_.seams(), hit.chart, footprint, weights_.lookup(footprint), lookups)
                      .channel[0];
    const float part = cluster_part(footprint, weights_.extent(0));
    std::array<float, kMaxChannels> mean;
    if (part > 0 && clusters_.lookup({hit.position, hit.normal, frame.x * width, frame.y * width}, mean))
      value = value * (1 - part) + mean[0] * part;
    return value;
  }

 private:
  const Surface& surface_;
  WeightPyramid weights_;
  SurfaceClusters clusters_;
};

/// Adds up squares.
class SquareSum {
 public:
  void add(double value) { sum_ += value * value, ++count_; }
  double rms() const { return count_ > 0 ? std::sqrt(sum_ / count_) : 0; }

 private:
  double sum_ = 0;
  int count_ = 0;
};

/// Zero if there is nothing to compare with.
double ratio(const SquareSum& a, const SquareSum& b) { return b.rms() > 0 ? a.rms() / b.rms() : 0; }

struct Sample {
  float difference = 0, reference = 0;
  bool at_seam = false;
  std::optional<float> difference_recut;  ///< beside seams: the same in the other atlas, where it is not beside one
};

class FarErrorMeasurement {
 public:
  FarErrorMeasurement(const Surface& surface, const Surface& recut, int size)
      : noise_(surface), map_(noise_, surface, size), recut_map_(noise_, recut, size) {}

  FarError run() const {
    FarError result;
    SquareSum seam, interior, paired_seam, paired_recut;
    for (int level = 1; level <= kLevels; ++level) {
      std::vector<Sample> samples(kFootprints);
      parallel_for(kFootprints, [&](std::size_t i) { samples[i] = measure(level, i); });
      SquareSum error, power;
      for (const Sample& s : samples) {
        error.add(s.difference), power.add(s.reference);
        (s.at_seam ? seam : interior).add(s.difference);
        if (s.difference_recut) paired_seam.add(s.difference), paired_recut.add(*s.difference_recut);
      }
      if (level == kNearLevels) result.near_seam_over_recut = ratio(paired_seam, paired_recut);
      result.by_level[level - 1] = error.rms() / power.rms();
    }
    result.seam_over_interior = ratio(seam, interior);
    result.seam_over_recut = ratio(paired_seam, paired_recut);
    return result;
  }

 private:
  /// Beside a seam for every other index, away from seams else, as far as there are such places.
  HitCoordinates random_place(int level, std::size_t index) const {
    Random random(hash64(static_cast<std::uint64_t>(level), index));
    constexpr int kTries = 1000;
    HitCoordinates where;
    for (int i = 0; i < kTries; ++i) {
      where = noise_.random_place(random);
      if (map_.is_at_seam(map_.hit(where).uv) == (index % 2 == 1)) break;
    }
    return where;
  }

  Sample measure(int level, std::size_t index) const {
    const HitCoordinates where = random_place(level, index);
    const float width = map_.texel() * static_cast<float>(1 << level);
    const SurfaceHit hit = map_.hit(where), recut_hit = recut_map_.hit(where);
    Sample sample;
    sample.at_seam = map_.is_at_seam(hit.uv);
    sample.reference = noise_.area_average(hit, width);
    sample.difference = map_.look_up(hit, width) - sample.reference;
    if (sample.at_seam && !recut_map_.is_at_seam(recut_hit.uv))
      sample.difference_recut = recut_map_.look_up(recut_hit, width) - sample.reference;
    return sample;
  }

  NoiseOnMesh noise_;
  NoiseMap map_, recut_map_;
};

}  // namespace

FarError measure_far_error(const Surface& surface, const Surface& recut, int size) {
  return FarErrorMeasurement(surface, recut, size).run();
}

}  // namespace redmap::bench
