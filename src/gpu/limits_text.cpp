#include "gpu/limits_text.h"

#include <fmt/format.h>

#include "lobes/gaussian_points.h"
#include "lobes/lobe_limits.h"
#include "map/lookup_limits.h"
#include "scene/layer_limits.h"

namespace redmap {
namespace {

struct Limit {
  const char* name;
  float value;
};
constexpr Limit kLimits[] = {
    {"shortest_half", kShortestHalf},
    {"least_facing", kLeastFacing},
    {"least_mean_z", kLeastMeanZ},
    {"largest_scale", kLargestScale},
    {"corrected_up_to", kCorrectedUpTo},
    {"calibrated_from", kCalibratedFrom},
    {"two_normals", kTwoNormals},
    {"few_normals", kFewNormals},
    {"few_normals_fast", kFewNormalsFast},
    {"spread_begin", kSpreadBegin},
    {"spread_end", kSpreadEnd},
    {"steepest", kSteepest},
    {"lookup_anisotropy", kLookupAnisotropy},
    {"tap_spacing", kTapSpacing},
    {"texel_per_minor", kTexelPerMinor},
    {"max_taps", kMaxTaps},
    {"clusters_begin", kClustersBegin},
    {"cluster_support", kClusterSupport},
    {"cluster_side_slope", kClusterSideSlope},
    {"cluster_round", kClusterRound},
    {"gather_anisotropy", kGatherAnisotropy},
    {"gather_least_width", kGatherLeastWidth},
    {"gather_blend_from", kGatherBlendFrom},
    {"gathered_texels", kGatheredTexels},
    {"gathered_grain_texels", kGatheredGrainTexels},
    {"one_turn", kOneTurn},
    {"one_drawn_turn", kOneDrawnTurn},
    {"one_drawn_normal", kOneDrawnNormal},
    {"whole_coverage", kWholeCoverage},
    {"least_mended_reach", kLeastMendedReach},
    {"blend_begin", kBlendBegin},
    {"blend_end", kBlendEnd},
    {"largest_turn", kLargestTurn},
    {"least_cosine", kLeastCosine},
    {"least_throughput", kLeastThroughput},
    {"roundings", kRoundings},
};

}  // namespace

std::string limits_text() {
  std::string text;
  for (const Limit& limit : kLimits) text += fmt::format("const float redmap_{} = {:.9e};\n", limit.name, limit.value);
  text += fmt::format("const int redmap_drawn_normals = {};\n", kDrawnNormals);
  return text + fmt::format("const int redmap_seam_pieces = {};\n", kSeamPieces);
}

}  // namespace redmap
