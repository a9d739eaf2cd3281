// Mixtures of a map's basis with weights that come from elsewhere than its lookup, at every hit by itself.
#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "analysis/basis.h"
#include "analysis/sampling.h"
#include "render/basis_shading.h"
#include "render/shading.h"

namespace redmap {

/// Where weights come from.
struct WeightSource {
  /// weights[basis][hit], padded with zeros. `patterns`: the shader's at the hits, where they are asked for.
  std::function<std::vector<LaneVector<float>>(const ShadingBatch& batch, const BoundPatterns* patterns)> at;
  bool asks_shader = false;
};

/// Shades every hit about its own shading normal, which `shader` says, by `basis` with these weights.
std::unique_ptr<ObjectShading> make_weighted_shading(std::shared_ptr<const Shader> shader,
                                                     std::shared_ptr<const BasisShading> basis, WeightSource weights);

/// Best weights of the reflectance at each hit: the projection of the bake, without texels. `scales` of the rows.
WeightSource projected_weights(const Shader& shader, const ReductionMap& map, std::vector<float> scales);
/// Those of the base texel that the hit lies in.
WeightSource texel_weights(std::shared_ptr<const ReductionMap> map);
/// The same everywhere, one number a basis reflectance.
WeightSource constant_weights(std::vector<float> weights);

}  // namespace redmap
