#include "gpu/bake_rows.h"

#include <algorithm>
#include <cmath>

#include "bake/bake.h"
#include "gpu/bake.h"
#include "quality/bench_scene.h"
#include "shader/shader.h"

namespace redmap::bench {
namespace {

/// One step of a byte, and what rounding to a byte may add to it.
constexpr double kOneByte = 1.5 / 255;

}  // namespace

MapDifference compare_maps(const ReductionMap& a, const ReductionMap& b) {
  MapDifference result;
  result.same_basis = a.basis.size() == b.basis.size() && a.weights.extent(0) == b.weights.extent(0);
  if (!result.same_basis) return result;
  const auto [width, height] = a.weights.extent(0);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const double coverage = std::abs(a.weights.coverage(0, x, y) - b.weights.coverage(0, x, y));
      if (a.weights.coverage(0, x, y) <= 0 && b.weights.coverage(0, x, y) <= 0) continue;
      ++result.covered;
      bool differs = coverage > kOneByte;
      for (int c = 0; c < a.weights.channels(); ++c) {
        const double difference =
            std::abs(a.weights.value(0, x, y, c) - b.weights.value(0, x, y, c)) / a.weights.scales()[c];
        result.mean_weight += difference;
        differs = differs || difference > kOneByte;
      }
      result.flipped += differs;
    }
  result.mean_weight /= static_cast<double>(std::max<std::size_t>(1, result.covered) * a.basis.size());
  return result;
}

BakeRow measure_bake(const Surface& surface, const std::string& shader, int size, const std::string& device) {
  const std::shared_ptr<const Shader> made = make_library_shader(shader);
  BakeOptions options;
  options.size = size;
  BakeReport cpu, gpu;
  const ReductionMap expected = bake(surface, *made, options, &cpu);
  const ReductionMap found = bake(surface, *made, options, *make_device_passes(device), &gpu);
  return {shader, size, gpu.seconds, cpu.seconds, compare_maps(expected, found)};
}

std::vector<BakeRow> measure_bakes(const BakeRowOptions& options) {
  const std::shared_ptr<const Surface> surface = make_bench_surface(options.object, options.models);
  const std::vector<std::string> shaders = options.shaders.empty() ? library_shader_names() : options.shaders;
  std::vector<BakeRow> rows;
  for (const std::string& shader : shaders) {
    if (options.cancelled && options.cancelled()) break;
    rows.push_back(measure_bake(*surface, shader, options.size, options.device));
    if (options.progress) options.progress(static_cast<double>(rows.size()) / static_cast<double>(shaders.size()));
  }
  return rows;
}

}  // namespace redmap::bench
