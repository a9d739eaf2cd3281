// The passes over all texels, which take nearly all the time of a bake. What lies between them is the same wherever
// they run.
#pragma once

#include <cstdint>
#include <memory>
#include <span>

#include "bake/bake.h"
#include "bake/texel_grid.h"
#include "map/pyramid.h"

namespace redmap {

struct SampledTexels;
struct ChosenBasis;
struct KnownWeights;
struct ProjectedPoints;

/// What is baked, and how.
struct BakeJob {
  const TexelGrid& grid;
  const Shader& shader;
  const BakeOptions& options;
  const DirectionPairs& directions;
  BakeMonitor& monitor;
};

/// Where the passes run. All throw BakeInterrupted, and Error on reflectances that are no numbers. Results do not
/// depend on the order in which texels are visited.
class TexelPasses {
 public:
  virtual ~TexelPasses() = default;
  /// Samples the centre of every texel: fills in `sampled.id` and the distinct reflectances of `sampled.unique`.
  virtual void sample(const BakeJob& job, SampledTexels& sampled) = 0;
  /// Replaces the `wanted` texels of `base` by the average of the weights of `sub_samples`^2 points each, and their
  /// coverage by the part of these that lie on the surface. Reflectances that are `known` have the weights known,
  /// others are fitted.
  virtual ProjectedPoints average(const BakeJob& job, const SampledTexels& sampled, const ChosenBasis& basis,
                                  const KnownWeights& known, std::span<const std::uint8_t> wanted, int sub_samples,
                                  BaseLevel& base) = 0;
  virtual WeightPyramid build_pyramid(const BaseLevel& base) = 0;
};

/// On the CPU, whatever the shader.
std::unique_ptr<TexelPasses> make_cpu_passes();

}  // namespace redmap
