#include "bake/verdict.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "bake/baselines.h"
#include "base/random.h"

namespace redmap {
namespace {

/// Squares of base texels that are looked at, each with all averages of levels 2 to 5 in it: 5 440 averages.
constexpr int kSquares = 64;
constexpr int kFinestLevel = 2, kCoarsestLevel = 5;
static_assert(1 << kCoarsestLevel == kTile);
/// Relative RMS difference up to which one averaged material is as good as the mixture: about what the lookup and the
/// sub-samples leave (docs/bake.md).
constexpr double kOneMaterialDifference = 0.02;
constexpr std::uint64_t kSeed = 17;

/// A square of base texels, sampled at their centres. Texels without surface count nothing.
struct Square {
  SampledReflectances sampled;
  Materials materials;
  std::vector<std::uint32_t> texel;
};

Square sample_square(const TexelGrid& grid, const Shader& shader, const SampledTexels& sampled, TexelRegion region) {
  Square square;
  TexelPoints found;
  grid.surface().rasterize(grid.extent(), region, sub_sample_offsets(1), {}, found);
  square.texel = found.texel;
  if (found.points.size() == 0) return square;
  const auto patterns = shader.bind(found.points);
  sampled.sampler.sample(*patterns, square.sampled);
  patterns->materials(square.materials);
  return square;
}

/// Reflectances and averaged materials of the blocks of one level in a square.
struct Averages {
  std::vector<float> reflectance;  ///< blocks x rows
  std::vector<float> parameters;   ///< blocks x channels
  std::vector<int> count;
};

Averages average_blocks(const Square& square, int width, int level) {
  const int across = (width + (1 << level) - 1) >> level, rows = square.sampled.rows;
  const int blocks = across * (kTile >> level);
  Averages averages{std::vector<float>(blocks * rows), std::vector<float>(blocks * ParameterChannels::kCount),
                    std::vector<int>(blocks)};
  for (std::size_t i = 0; i < square.texel.size(); ++i) {
    const int x = static_cast<int>(square.texel[i]) % width, y = static_cast<int>(square.texel[i]) / width;
    const int block = (y >> level) * across + (x >> level);
    ++averages.count[block];
    for (int r = 0; r < rows; ++r) averages.reflectance[block * rows + r] += square.sampled.row(r)[i];
    std::array<float, ParameterChannels::kCount> channels;
    parameter_channels(square.materials, i, channels.data());
    for (int c = 0; c < ParameterChannels::kCount; ++c)
      averages.parameters[block * ParameterChannels::kCount + c] += channels[c];
  }
  return averages;
}

/// Sums of squares of a difference, and of what it is relative to.
struct Difference {
  double square = 0, reference = 0;
};

/// What one averaged material per block gets wrong, over the reflection samples.
void add_difference(const Averages& averages, const SampledTexels& sampled, Difference& sum) {
  const DirectionPairs& directions = sampled.sampler.directions();
  const int rows = sampled.sampler.rows();
  Materials materials;
  materials.resize(directions.size());
  Planes<3> radiance;
  for (std::size_t b = 0; b < averages.count.size(); ++b) {
    if (averages.count[b] == 0) continue;
    const float part = 1.0f / static_cast<float>(averages.count[b]);
    std::array<float, ParameterChannels::kCount> channels;
    for (int c = 0; c < ParameterChannels::kCount; ++c)
      channels[c] = part * averages.parameters[b * ParameterChannels::kCount + c];
    for (std::size_t d = 0; d < directions.size(); ++d) set_material(channels.data(), d, materials);
    material_radiance_each(materials, directions, radiance);
    for (int r = 0; r < static_cast<int>(3 * directions.size()); ++r) {
      const double mixture = sampled.row_scales[r] * part * averages.reflectance[b * rows + r];
      const double material = sampled.row_scales[r] * radiance[r % 3][r / 3];
      sum.square += (material - mixture) * (material - mixture);
      sum.reference += mixture * mixture;
    }
  }
}

/// RMS difference between the averaged reflectances of random places on levels 2 to 5 and those of one averaged
/// material.
double one_material_difference(const TexelGrid& grid, const Shader& shader, const SampledTexels& sampled) {
  Difference sum;
  for (int i = 0; i < kSquares; ++i) {
    const std::size_t tile = hash64(kSeed, i) % grid.tiles();
    const TexelRegion region = grid.tile(tile);
    const Square square = sample_square(grid, shader, sampled, region);
    if (square.texel.empty()) continue;
    for (int level = kFinestLevel; level <= kCoarsestLevel; ++level)
      add_difference(average_blocks(square, region.width, level), sampled, sum);
  }
  return sum.reference > 0 ? std::sqrt(sum.square / sum.reference) : 0;
}

}  // namespace

void judge(const TexelGrid& grid, const Shader& shader, const SampledTexels& sampled, ReductionMap& map) {
  map.verdict = MapVerdict::kReduces;
  if (shader.info().varies_in_time) {
    map.verdict = MapVerdict::kDoesNotReduce;
    map.verdict_reason = "the shader varies in time: a map holds one moment";
  } else if (map.residual > map.tolerance) {
    map.verdict = MapVerdict::kDoesNotReduce;
    map.verdict_reason = fmt::format("{} basis reflectances leave a residual of {:.3f}, over the tolerance of {:.3f}",
                                     map.basis.size(), map.residual, map.tolerance);
  } else if (shader.info().has_material && !shader.info().emits && !shader.info().perturbs_normals &&
             !shader.info().turns_tangents) {
    // Averaged parameters hold no emission, and what normals do to them is not asked here.
    const double difference = one_material_difference(grid, shader, sampled);
    if (difference >= kOneMaterialDifference) return;
    map.verdict = MapVerdict::kOneMaterial;
    map.verdict_reason = fmt::format(
        "one averaged material differs from the mixture by {:.1f} %: mip-mapped parameters would do", 100 * difference);
  }
}

}  // namespace redmap
