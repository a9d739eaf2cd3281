#include "bake/normals.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/parallel.h"

namespace redmap {
namespace {

/// Shading normals that lean over farther than this are seen from below almost everywhere: their z is held there.
constexpr float kLeastZ = 0.05f;

/// Two kinds of normals meet in a texel when halves of it, split across their longest spread, have less than this part
/// of the variance left: 1/4 is what a slope leaves, .36 a Gaussian.
constexpr float kCrease = 0.15f;
/// Variances below this are narrower than highlights, whatever they are made of.
constexpr float kNarrow = 4e-4f;

Vec2 tilt_of(const SurfacePoints& points, const Planes<3>& normals, std::size_t i) {
  const Vec3 normal = points.normal.get(i), tangent = points.tangent.get(i);
  const Vec3 local = Frame{tangent, cross(normal, tangent), normal}.to_local(normals.get(i));
  const Vec3 n = normalized({local.x, local.y, std::max(local.z, kLeastZ)});
  return {n.x, n.y};
}

using Moments = std::array<float, NormalPyramid::kMoments>;

struct Cluster {
  Moments moments{};
  float count = 0;
  void add(Vec2 tilt) {
    const float values[] = {tilt.x, tilt.y, tilt.x * tilt.x, tilt.x * tilt.y, tilt.y * tilt.y};
    for (std::size_t m = 0; m < moments.size(); ++m) moments[m] += values[m];
    ++count;
  }
  Vec2 mean() const { return {moments[0] / count, moments[1] / count}; }
  float variance() const {  // of both axes
    return (moments[2] + moments[4]) / count - dot(mean(), mean());
  }
};

/// The moments of one texel's tilts. Where two kinds of normals meet, those of one of them, by chance in proportion to
/// its area: from texel to texel that is right on average, and a highlight stays as sharp as it is. `threshold`: 0
/// to 1.
Moments moments_of(std::span<const Vec2> tilts, float threshold) {
  Cluster all;
  for (Vec2 tilt : tilts) all.add(tilt);
  const auto mean_moments = [](const Cluster& c) {
    Moments m = c.moments;
    for (float& value : m) value /= c.count;
    return m;
  };
  const float variance = all.variance();
  if (variance < kNarrow) return mean_moments(all);

  // Across the larger axis of the covariance.
  const Vec2 mean = all.mean();
  const float xx = all.moments[2] / all.count - mean.x * mean.x, xy = all.moments[3] / all.count - mean.x * mean.y;
  const float yy = all.moments[4] / all.count - mean.y * mean.y;
  const float angle = 0.5f * std::atan2(2 * xy, xx - yy);
  const Vec2 axis{std::cos(angle), std::sin(angle)};
  Cluster halves[2];
  for (Vec2 tilt : tilts) halves[dot(tilt - mean, axis) > 0].add(tilt);
  if (halves[0].count == 0 || halves[1].count == 0) return mean_moments(all);
  const float left = (halves[0].count * halves[0].variance() + halves[1].count * halves[1].variance()) / all.count;
  if (left > kCrease * variance) return mean_moments(all);
  return mean_moments(halves[threshold * all.count < halves[1].count]);
}

/// Evenly spread over neighbouring texels (the R2 sequence, Roberts 2018).
float threshold_at(std::size_t texel, int width) {
  const double x = static_cast<double>(texel % width), y = static_cast<double>(texel / width);
  const double value = 0.7548776662466927 * x + 0.5698402909980532 * y;
  return static_cast<float>(value - std::floor(value));
}

}  // namespace

BaseLevel sample_normals(const TexelGrid& grid, const Shader& shader, int sub_samples, BakeMonitor& monitor) {
  struct Slot {
    Planes<3> normals;
    std::vector<Vec2> tilts;
  };
  monitor.begin("normals", 0.99f);
  BaseLevel moments(grid.extent(), NormalPyramid::kMoments, grid.surface().wraps_u());
  std::vector<Slot> slots(pipeline_slots());
  const auto evaluate = [&](const SurfacePoints& points, std::span<const std::size_t> texel, std::size_t index,
                            float* out) {
    Slot& slot = slots[index];
    shader.bind(points)->shading_normals(slot.normals);
    for (std::size_t begin = 0, end = 0; begin < texel.size(); begin = end) {
      slot.tilts.clear();
      for (end = begin; end < texel.size() && texel[end] == texel[begin]; ++end)
        slot.tilts.push_back(tilt_of(points, slot.normals, end));
      const Moments chosen = moments_of(slot.tilts, threshold_at(texel[begin], grid.extent().width));
      for (std::size_t i = begin; i < end; ++i) out = std::copy(chosen.begin(), chosen.end(), out);
    }
  };
  average_texels(grid, std::vector<std::uint8_t>(grid.texels(), 1), sub_samples, evaluate, nullptr, monitor, moments);
  return moments;
}

}  // namespace redmap
