#include "bake/baselines.h"

#include <algorithm>
#include <cmath>

#include "bake/texel_grid.h"
#include "base/error.h"
#include "base/parallel.h"
#include "map/normal_moments.h"
#include "map/slope_moments.h"
#include "shader/shading_frames.h"

namespace redmap {
namespace {

using Channels = ParameterChannels;

/// Points across a texel, as the default of BakeOptions.
constexpr int kSubSamples = 4;
/// Channels that differ by more are worth sub-samples: two steps of eight bits.
constexpr float kDifference = 2.0f / 255;
/// So are slopes that differ by a fifth of the narrowest lobe's width (GGX of roughness .05).
constexpr float kSlopeDifference = 0.01f;
/// Every texel from its centre, then from sub-samples where neighbours differ.
Pyramid<float> build_averaged(const Surface& surface, int size, int channels, const EvaluatePoints& evaluate,
                              const ValuesDiffer& differ) {
  const TexelGrid grid(surface, size);
  BaseLevel base(grid.extent(), channels, surface.wraps_u());
  BakeMonitor monitor(nullptr);
  average_texels(grid, std::vector<std::uint8_t>(grid.texels(), 1), 1, evaluate, nullptr, monitor, base);
  average_texels(grid, find_differing_texels(base, differ), kSubSamples, evaluate, nullptr, monitor, base);
  return Pyramid<float>(base);
}

/// From the shading frames to those along the interpolated tangents: what is averaged must be in one frame.
void turn_roughness(const SurfacePoints& points, const BoundPatterns& patterns, Materials& materials) {
  Planes<3> normals, tangents;
  if (!patterns.shading_normals(normals)) normals = points.normal;
  patterns.shading_tangents(tangents);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Vec2 turn = tangent_turn(normals.get(i), points.tangent.get(i), tangents.get(i));
    const Vec3 own = materials.roughness.get(i);  // xx, xy, yy
    const float cc = turn.x * turn.x, ss = turn.y * turn.y, cs = turn.x * turn.y;
    materials.roughness.set(i, {cc * own.x - 2 * cs * own.y + ss * own.z, cs * (own.x - own.z) + (cc - ss) * own.y,
                                ss * own.x + 2 * cs * own.y + cc * own.z});
  }
}

Pyramid<float> build_normal_distributions(const Surface& surface, const Shader& shader, int size) {
  std::vector<Planes<3>> slots(pipeline_slots());
  const auto evaluate = [&](const SurfacePoints& points, std::span<const std::size_t>, std::size_t slot, float* out) {
    shader.bind(points)->shading_normals(slots[slot]);
    for (std::size_t i = 0; i < points.size(); ++i) normal_moments(slots[slot].get(i), out + i * NormalMoments::kCount);
  };
  return build_averaged(surface, size, NormalMoments::kCount, evaluate, [](const float* a, const float* b) {
    return std::max({std::abs(a[0] - b[0]), std::abs(a[1] - b[1]), std::abs(a[2] - b[2])}) > kSlopeDifference;
  });
}

}  // namespace

Pyramid<float> build_parameter_pyramid(const Surface& surface, const Shader& shader, int size) {
  if (!shader.info().has_material)
    throw Error("parameters: shader \"{}\" declares no material(): expected one for this baseline", shader.info().name);
  std::vector<Materials> slots(pipeline_slots());
  const auto evaluate = [&](const SurfacePoints& points, std::span<const std::size_t>, std::size_t slot, float* out) {
    const auto patterns = shader.bind(points);
    patterns->materials(slots[slot]);
    if (shader.info().turns_tangents) turn_roughness(points, *patterns, slots[slot]);
    for (std::size_t i = 0; i < points.size(); ++i) parameter_channels(slots[slot], i, out + i * Channels::kCount);
  };
  return build_averaged(surface, size, Channels::kCount, evaluate, [](const float* a, const float* b) {
    for (int c = 0; c < Channels::kCount; ++c)
      if (std::abs(a[c] - b[c]) > kDifference * std::max(std::abs(a[c]), std::abs(b[c]))) return true;
    return false;
  });
}

Pyramid<float> build_slope_pyramid(const Surface& surface, const Shader& shader, int size) {
  if (!shader.info().perturbs_normals)
    throw Error("slopes: shader \"{}\" declares no shading_normal(): expected one for this baseline",
                shader.info().name);
  std::vector<Planes<3>> slots(pipeline_slots());
  const auto evaluate = [&](const SurfacePoints& points, std::span<const std::size_t>, std::size_t slot, float* out) {
    shader.bind(points)->shading_normals(slots[slot]);
    for (std::size_t i = 0; i < points.size(); ++i) {
      const Vec3 normal = points.normal.get(i), tangent = points.tangent.get(i);
      const Frame frame{tangent, cross(normal, tangent), normal};
      slope_moments(frame.to_local(slots[slot].get(i)), out + i * SlopeMoments::kCount);
    }
  };
  return build_averaged(surface, size, SlopeMoments::kCount, evaluate, [](const float* a, const float* b) {
    return std::max(std::abs(a[0] - b[0]), std::abs(a[1] - b[1])) > kSlopeDifference;
  });
}

Pyramid<float> build_normal_pyramid(const Surface& surface, const Shader& shader, int size) {
  if (shader.info().perturbs_normals) return build_normal_distributions(surface, shader, size);
  const auto evaluate = [](const SurfacePoints& points, std::span<const std::size_t>, std::size_t, float* out) {
    for (std::size_t i = 0; i < points.size(); ++i)
      for (int c = 0; c < 3; ++c) out[3 * i + c] = points.normal[c][i];
  };
  // Normals are smooth within a chart; only its border, where coverage changes, needs sub-samples.
  return build_averaged(surface, size, 3, evaluate, [](const float*, const float*) { return false; });
}

}  // namespace redmap
