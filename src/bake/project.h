// Choosing the basis among the distinct reflectances, and second pass over the texels: their weights (paper, section
// 4.2.2), averaged over sub-samples where neighbours differ.
#pragma once

#include <vector>

#include "analysis/basis.h"
#include "bake/bake.h"
#include "bake/sample.h"
#include "bake/texel_grid.h"

namespace redmap {

/// Basis reflectances with their places, and the scaled vectors they were sampled as.
struct ChosenBasis {
  ReflectanceBasis reflectances;
  std::vector<float> scaled;  ///< row by row
  std::vector<ReflectancePlace> places;
  float residual = 0;  ///< largest among the vectors seen so far
  int outliers = 0;    ///< of the basis, those that only sub-samples brought to light
};
ChosenBasis choose(const SampledTexels& sampled, const BakeOptions& options);

/// Weights of every texel, one channel a basis reflectance. Sub-samples that the basis does not represent extend it
/// while it may grow; `basis.residual` becomes the largest over all points. Frees `sampled.id`. Throws BakeInterrupted,
/// and Error on reflectances that are no numbers.
BaseLevel project(const TexelGrid& grid, const Shader& shader, const BakeOptions& options, SampledTexels& sampled,
                  ChosenBasis& basis, BakeMonitor& monitor, BakeReport& report);

}  // namespace redmap
