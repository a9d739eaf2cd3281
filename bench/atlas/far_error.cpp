#include "atlas/far_error.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "bake/surface_cells.h"
#include "bake/texel_grid.h"
#include "base/parallel.h"
#include "base/random.h"
#include "map/pyramid.h"
#include "render/hit_footprint.h"
#include "surface/mesh.h"

namespace redmap::bench {
namespace {

/// Noise cells across the object's longest side: like the library's noise shader on a sphere.
constexpr float kNoiseCells = 28;

/// Footprints a level, half of them beside seams.
constexpr std::size_t kFootprints = 400;
constexpr float kSeamTexels = 2;

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

class FarErrorMeasurement {
 public:
  FarErrorMeasurement(const Surface& surface, int size) : surface_(surface), mesh_(*surface.mesh()) {
    const Vec3 extent = surface.upper() - surface.lower();
    frequency_ = kNoiseCells / std::max({extent.x, extent.y, extent.z});
    bake(size);
    const double texels = surface.uv_area() * weights_.extent(0).width * weights_.extent(0).height;
    texel_ = static_cast<float>(std::sqrt(surface.area() / texels));
    for (std::size_t t = 0; t < mesh_.triangles.size(); ++t) areas_.push_back(total_area_ += triangle_area(t));
  }

  FarError run() const {
    FarError result;
    double seam = 0, interior = 0;
    std::size_t seam_count = 0, interior_count = 0;
    for (int level = 1; level <= kLevels; ++level) {
      std::vector<Sample> samples(kFootprints);
      parallel_for(kFootprints, [&](std::size_t i) { samples[i] = measure(level, i); });
      double error = 0, power = 0;
      for (const Sample& s : samples) {
        const double squared = double(s.difference) * s.difference;
        error += squared, power += double(s.reference) * s.reference;
        (s.at_seam ? seam : interior) += squared;
        ++(s.at_seam ? seam_count : interior_count);
      }
      result.by_level[level - 1] = std::sqrt(error / power);
    }
    if (seam_count > 0 && interior_count > 0)
      result.seam_over_interior =
          std::sqrt(seam / static_cast<double>(seam_count) / (interior / static_cast<double>(interior_count)));
    return result;
  }

 private:
  struct Sample {
    float difference = 0, reference = 0;
    bool at_seam = false;
  };

  float signal(Vec3 position) const { return solid_noise((position - surface_.lower()) * frequency_); }
  Vec3 corner(std::size_t t, int k) const { return mesh_.positions[mesh_.triangles[t][k]]; }
  Vec3 doubled_normal(std::size_t t) const { return cross(corner(t, 1) - corner(t, 0), corner(t, 2) - corner(t, 0)); }
  double triangle_area(std::size_t t) const { return 0.5 * length(doubled_normal(t)); }

  void bake(int size) {
    const TexelGrid grid(surface_, size);
    BaseLevel base(grid.extent(), 1, surface_.wraps_u());
    BakeMonitor monitor(nullptr);
    const std::vector<std::uint8_t> all(grid.texels(), 1);
    average_texels(
        grid, all, 4,
        [&](const SurfacePoints& points, std::span<const std::size_t>, std::size_t, float* out) {
          for (std::size_t i = 0; i < points.size(); ++i) out[i] = signal(points.position.get(i));
        },
        nullptr, monitor, base);
    weights_ = WeightPyramid(base);
    clusters_ = build_clusters(surface_, weights_);
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

  /// A place evenly distributed over the surface: beside a seam for every other index, away from seams else.
  SurfaceHit random_place(int level, std::size_t index, bool& at_seam) const {
    Random random(hash64(static_cast<std::uint64_t>(level), index));
    constexpr int kTries = 1000;
    SurfaceHit hit;
    for (int i = 0; i < kTries; ++i) {
      const double area = total_area_ * random.next_float();
      const std::size_t t = std::min<std::size_t>(std::upper_bound(areas_.begin(), areas_.end(), area) - areas_.begin(),
                                                  areas_.size() - 1);
      Vec2 where{random.next_float(), random.next_float()};
      if (where.x + where.y > 1) where = {1 - where.x, 1 - where.y};
      const HitCoordinates coordinates{static_cast<std::uint32_t>(t), where};
      surface_.complete({&coordinates, 1}, {&hit, 1});
      at_seam = is_at_seam(hit.uv);
      if (at_seam == (index % 2 == 1)) break;
    }
    return hit;
  }

  Sample measure(int level, std::size_t index) const {
    Sample sample;
    const SurfaceHit hit = random_place(level, index, sample.at_seam);
    const float width = texel_ * static_cast<float>(1 << level);
    sample.reference = area_average(hit, width);
    sample.difference = look_up(hit, width) - sample.reference;
    return sample;
  }

  float look_up(const SurfaceHit& hit, float width) const {
    const Frame frame = make_frame(hit.geometric_normal, hit.dp_du);
    const Footprint footprint = round_footprint(hit, width);
    float value = weights_.lookup(footprint).channel[0];
    const float part = cluster_part(footprint, weights_.extent(0));
    std::array<float, kMaxChannels> mean;
    if (part > 0 && clusters_.lookup({hit.position, hit.normal, frame.x * width, frame.y * width}, mean))
      value = value * (1 - part) + mean[0] * part;
    return value;
  }

  float area_average(const SurfaceHit& hit, float width) const {
    const Frame frame = make_frame(hit.geometric_normal, hit.dp_du);
    double sum = 0, weight = 0;
    for (std::size_t t = 0; t < mesh_.triangles.size(); ++t) {
      if (dot(doubled_normal(t), hit.normal) <= 0 || !reaches(t, frame, hit.position, width)) continue;
      add_triangle(t, frame, hit.position, width, sum, weight);
    }
    return weight > 0 ? static_cast<float>(sum / weight) : signal(hit.position);
  }

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
        sum += area / (n * n) * signal(p), weight += area / (n * n);
      }
  }

  const Surface& surface_;
  const TriangleMesh& mesh_;
  float frequency_ = 1, texel_ = 1;
  double total_area_ = 0;
  std::vector<double> areas_;  ///< cumulated
  WeightPyramid weights_;
  SurfaceClusters clusters_;
};

}  // namespace

FarError measure_far_error(const Surface& surface, int size) { return FarErrorMeasurement(surface, size).run(); }

}  // namespace redmap::bench
