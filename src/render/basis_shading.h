// The basis reflectances of a map, evaluated: at one normal a hit, or integrated over a distribution of normals without
// a ray (docs/normals.md).
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "lobes/lobe_lanes.h"
#include "map/normal_mixtures.h"
#include "render/shading.h"

namespace redmap {

class BasisShading {
 public:
  BasisShading(const Shader& shader, const ReductionMap& map);

  /// out.radiance and out.transmittance of a batch, given the weights of each hit, weights[b][i], at the z of `frames`.
  void shade(const ShadingBatch& batch, std::span<const Frame> frames, std::span<const LaneVector<float>> weights,
             ShadedBatch& out, RenderCounts& counts) const;
  /// The same over distributions around the z of the batch's frames: those of `mixtures`, one a hit, all with mean
  /// (0, 0, 1). Where a highlight is wide beside them their mean has to do.
  void shade_around(const ShadingBatch& batch, const NormalMixtures& mixtures, ShadedBatch& out,
                    RenderCounts& counts) const;
  /// Integrated over the normals of `mixtures` in the frames of the batch.
  void integrate(const ShadingBatch& batch, const NormalMixtures& mixtures, ShadedBatch& out,
                 RenderCounts& counts) const;
  Rgb transmittance(const FilteredTexel& texel) const;

 private:
  /// What integrals need to know of a basis reflectance.
  struct Lobes {
    LobeModel model;
    WidthsInUse in_use;
    float narrowest = 0;
    bool trusted = false;  ///< where not, normals are drawn
  };
  void add_constants(std::span<const LaneVector<float>> weights, ShadedBatch& out) const;
  /// Replaces, in the radiance of basis reflectance `basis` at mean normals, what the spread of the normals changes.
  void spread_radiance(std::size_t basis, const DirectionPairs& pairs, const NormalMixtures& mixtures,
                       std::span<const std::uint8_t> lit, Planes<3>& radiance, std::span<Decision> decisions,
                       RenderCounts& counts) const;
  /// The reflectance integrated over `mixtures`, with their weights [weights]. `at_mean`, unless null: what it has at
  /// the mean of every distribution, times the weight. Nothing is asked for hits that are not `lit` (empty: all are).
  /// Raises the decisions of hits that one normal does not do for.
  void integrate_basis(std::size_t basis, const DirectionPairs& pairs, const NormalMixtures& mixtures,
                       std::size_t weights, std::span<const std::uint8_t> lit, const Planes<3>* at_mean,
                       Planes<3>& radiance, std::span<Decision> decisions, RenderCounts& counts) const;
  /// The same for the hits `hits`, where the model does not fit.
  void draw_normals(std::size_t basis, const DirectionPairs& pairs, const NormalMixtures& mixtures, std::size_t weights,
                    std::span<const std::uint32_t> hits, Planes<3>& radiance, RenderCounts& counts) const;

  std::unique_ptr<BoundPatterns> patterns_;
  std::vector<Rgb> transmittance_, emission_;
  std::vector<Lobes> lobes_;
};

}  // namespace redmap
