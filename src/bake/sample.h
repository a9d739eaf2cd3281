// First pass over the texels: the reflectance at the centre of each, brought down to those that are distinct (paper,
// section 4.2.1).
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "analysis/sampling.h"
#include "analysis/unique_reflectances.h"
#include "bake/bake.h"
#include "bake/passes.h"
#include "bake/texel_grid.h"

namespace redmap {

/// Distinct reflectances that are kept to choose from. More give the same basis (16k out of 994k did, docs/bake.md).
inline constexpr std::size_t kMaxUnique = 16384;

struct SampledTexels {
  ReflectanceSampler sampler;
  std::vector<float> row_scales;
  ReflectanceKeys keys;
  UniqueReflectances unique;
  std::vector<std::uint32_t> id;  ///< texel_id() of the key at each texel's centre; 0 where there is no surface
};

/// What of a key is remembered a texel. Never zero.
inline std::uint32_t texel_id(std::uint64_t key) { return std::max<std::uint32_t>(1, static_cast<std::uint32_t>(key)); }

/// What is wrong with the reflectances that `shader` has at `points`, naming the shader and the first place; empty if
/// nothing is.
std::string find_problem(const Shader& shader, const SurfacePoints& points, const SampledReflectances& sampled);

/// Some hundred places all over the surface.
SurfacePoints some_points(const TexelGrid& grid);

/// Scales that bring every row to unit RMS, from some thousand random texels. Throws Error if none is covered
/// and on reflectances that are no numbers.
std::vector<float> estimate_row_scales(const TexelGrid& grid, const Shader& shader, const ReflectanceSampler& sampler,
                                       BakeMonitor& monitor);

/// Samples the centre of every texel. Throws BakeInterrupted, and Error on reflectances that are no numbers.
SampledTexels sample_texels(const BakeJob& job, TexelPasses& passes);

/// TexelPasses::sample() on the CPU.
void sample_on_cpu(const BakeJob& job, SampledTexels& sampled);

}  // namespace redmap
