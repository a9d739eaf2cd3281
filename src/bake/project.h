// Choosing the basis among the distinct reflectances, and second pass over the texels: their weights (paper, section
// 4.2.2), averaged over sub-samples where neighbours differ.
#pragma once

#include <unordered_map>
#include <vector>

#include "analysis/basis.h"
#include "bake/bake.h"
#include "bake/passes.h"
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

/// Weights of the distinct reflectances, found by key or by texel id.
struct KnownWeights {
  std::vector<BasisWeights> weights;
  std::vector<float> residuals;
  std::unordered_map<std::uint64_t, std::uint32_t> of_key;
  std::unordered_map<std::uint32_t, std::uint32_t> of_id;

  KnownWeights(const UniqueReflectances& unique, const ReflectanceBasis& basis);
};

/// What came of points that were projected onto a basis.
struct ProjectedPoints {
  float residual = 0;                       ///< largest of those within the tolerance
  float outlier_residual = 0;               ///< largest of the others, which are outliers
  UniqueReflectances outliers;              ///< the worst of each tile
  std::vector<std::size_t> outlier_texels;  ///< where they are

  explicit ProjectedPoints(int rows);
};

/// TexelPasses::average() on the CPU.
ProjectedPoints average_on_cpu(const BakeJob& job, const SampledTexels& sampled, const ChosenBasis& basis,
                               const KnownWeights& known, std::span<const std::uint8_t> wanted, int sub_samples,
                               BaseLevel& base);

/// Weights of every texel, one channel a basis reflectance. Sub-samples that the basis does not represent extend it
/// while it may grow; `basis.residual` becomes the largest over all points. Frees `sampled.id`. Throws BakeInterrupted,
/// and Error on reflectances that are no numbers.
BaseLevel project(const BakeJob& job, TexelPasses& passes, SampledTexels& sampled, ChosenBasis& basis,
                  BakeReport& report);

}  // namespace redmap
