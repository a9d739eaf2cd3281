#include "bake/tangents.h"

#include <cmath>

#include "base/parallel.h"
#include "map/tangent_moments.h"
#include "shader/shading_frames.h"

namespace redmap {
namespace {

/// Moments that differ by more, of two degrees or so, are worth sub-samples.
constexpr float kDifference = 0.04f;

}  // namespace

BaseLevel sample_tangents(const TexelGrid& grid, const Shader& shader, const BakeOptions& options,
                          BakeMonitor& monitor) {
  struct Slot {
    Planes<3> normals, tangents;
  };
  std::vector<Slot> slots(pipeline_slots());
  const auto evaluate = [&](const SurfacePoints& points, std::span<const std::size_t>, std::size_t slot, float* out) {
    auto& [normals, tangents] = slots[slot];
    const auto patterns = shader.bind(points);
    if (!patterns->shading_normals(normals)) normals = points.normal;
    patterns->shading_tangents(tangents);
    for (std::size_t i = 0; i < points.size(); ++i, out += TangentMoments::kCount)
      tangent_moments(tangent_turn(normals.get(i), points.tangent.get(i), tangents.get(i)), out);
  };
  const ValuesDiffer differ = [](const float* a, const float* b) {
    return std::max(std::abs(a[0] - b[0]), std::abs(a[1] - b[1])) > kDifference;
  };
  monitor.begin("tangents", 0.99f);
  BaseLevel base(grid.extent(), TangentMoments::kCount, grid.surface().wraps_u());
  average_texels(grid, std::vector<std::uint8_t>(grid.texels(), 1), 1, evaluate, nullptr, monitor, base);
  average_texels(grid, find_differing_texels(base, differ), options.sub_samples, evaluate, nullptr, monitor, base);
  return base;
}

}  // namespace redmap
