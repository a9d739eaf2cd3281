#include "bench_data.h"

#include <memory>
#include <string_view>
#include <utility>

#include "bake/baselines.h"

namespace redmap::bench {

bool has_parameters(const ShaderInfo& shader) { return shader.has_material && !shader.emits; }

ObjectData make_bench_data(const Surface& surface, const Shader& shader, int map_size,
                           const std::function<bool()>& cancelled, BakeReport* report) {
  const auto shared = [](Pyramid<float> pyramid) { return std::make_shared<const Pyramid<float>>(std::move(pyramid)); };
  ObjectData data;
  BakeOptions options;
  options.size = map_size;
  options.progress = [&](float, std::string_view) { return !(cancelled && cancelled()); };
  data.map = std::make_shared<const ReductionMap>(bake(surface, shader, options, report));
  if (has_parameters(shader.info())) data.parameters = shared(build_parameter_pyramid(surface, shader, map_size));
  if (shader.info().perturbs_normals) data.slopes = shared(build_slope_pyramid(surface, shader, map_size));
  data.normals = shared(build_normal_pyramid(surface, shader, map_size));
  return data;
}

}  // namespace redmap::bench
