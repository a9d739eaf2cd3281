// Baking: a surface and a shader become a reduction map (paper, sections 4.1 to 4.4). This is the easy call; the steps
// are in texel_grid.h, sample.h, project.h and verdict.h.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "base/error.h"
#include "map/reduction_map.h"
#include "shader/shader.h"
#include "surface/surface.h"

namespace redmap {

/// Who chooses the basis.
enum class BasisSelection {
  kGreedy,  ///< among all distinct reflectances, always the one fitted worst
  kPaper,   ///< the paper's: three of each 32 x 32 block, then among those
};

/// Part done of the whole bake, 0 to 1, and what is being done. Returns false to stop. Called from one thread at a
/// time.
using BakeProgress = std::function<bool(float fraction, std::string_view stage)>;

struct BakeOptions {
  int size = 1024;           ///< texels across the map, 1 to 16384
  float tolerance = 0.025f;  ///< largest residual: RMS over the direction samples, each scaled to unit RMS; above 0
  int max_basis = 8;         ///< most basis reflectances, 1 to kMaxBasis
  int sub_samples = 4;       ///< n x n points under a texel whose neighbours differ, 1 to 8
  BasisSelection selection = BasisSelection::kGreedy;
  BakeProgress progress;  ///< may be empty
};

/// What a bake did, apart from the map: not part of it, since times differ from run to run.
struct BakeReport {
  struct Stage {
    std::string name;
    double seconds = 0;
  };
  std::vector<Stage> stages;
  double seconds = 0;
  std::uint64_t peak_bytes = 0;  ///< of the whole process
  std::size_t covered_texels = 0;
  std::size_t refined_texels = 0;    ///< of these, sub-sampled because their neighbours differ
  double distinct_reflectances = 0;  ///< estimated where there are more than are kept
  int outlier_basis = 0;             ///< basis reflectances that only sub-samples brought to light
  /// Directions beside the paper's that it took for the basis to hold in all, and the largest residual in directions
  /// that were held out, without and with these (analysis/held_out.h).
  int added_directions = 0;
  float disagreement_of_table = 0, disagreement = 0;
  /// Where the shader hides its shading normals: places probed for them, and those where none was found, which keep the
  /// interpolated one.
  std::uint64_t probed_normals = 0, normals_not_found = 0;
};

/// The bake was stopped through its progress callback. Nothing is left behind.
class BakeInterrupted : public Error {
 public:
  BakeInterrupted() : Error("bake: interrupted") {}
};

/// Bakes `shader` on `surface`. The result is the same for any number of threads. A shader that does not reduce gives a
/// map that says so in its verdict. Throws Error on options out of range, on a surface without a covered texel, and
/// where the shader returns anything but numbers, naming it and the place.
ReductionMap bake(const Surface& surface, const Shader& shader, const BakeOptions& options = {},
                  BakeReport* report = nullptr);

/// The same where `passes` says (passes.h).
class TexelPasses;
ReductionMap bake(const Surface& surface, const Shader& shader, const BakeOptions& options, TexelPasses& passes,
                  BakeReport* report = nullptr);

}  // namespace redmap
