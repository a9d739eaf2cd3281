// Basis reflectances as materials of glTF, each fitted once to what the shader answers: a black box, as everywhere.
#pragma once

#include <vector>

#include "export/gltf_material.h"
#include "map/reduction_map.h"
#include "shader/shader.h"

namespace redmap {

/// Fits with a larger error are called poor. Tuned on the library: docs/export.md.
inline constexpr float kPoorFit = 0.12f;

struct MaterialFit {
  GltfMaterial material;
  /// RMS of the difference over RMS of the reflectance, in directions that the fit did not see; half vectors are
  /// spread evenly over the hemisphere, as over the pixels of a round object.
  float error = 0;
  bool is_poor() const { return error > kPoorFit; }
};

/// Pattern `index` of `patterns`, by nonlinear least squares from several starts.
MaterialFit fit_material(const BoundPatterns& patterns, std::size_t index);

/// Every basis reflectance of `map`, baked from `shader`. The same for any number of threads.
std::vector<MaterialFit> fit_basis(const ReductionMap& map, const Shader& shader);

}  // namespace redmap
