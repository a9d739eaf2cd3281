// Several rays and one shading: four samples that see one smooth piece of surface are shaded as one hit, whose
// footprint and whose turning of normals are differences between theirs. What is seen, and what is lit, is still
// decided ray by ray (decoupled sampling, Ragan-Kelley et al. 2011).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "render/shading.h"
#include "scene/camera_rays.h"

namespace redmap {

struct JoinedHits {
  ShadingBatch batch;                 ///< with footprints
  std::vector<std::uint32_t> first;   ///< hit i of `batch` is made of the four from first[i] on
  std::vector<std::uint32_t> single;  ///< the hits that stay what they are
};

/// In JoinedHits::first: the four are among the single ones after all.
inline constexpr std::uint32_t kTakenApart = ~0u;

/// Takes those apart that `shading`, which came to `decisions`, wants to be.
void take_apart(const ObjectShading& shading, std::span<const Decision> decisions, JoinedHits& joined);

/// Joins hits of `batch`, hit i of samples[sample_of[i]], wherever four one after the other make up a square of a
/// pixel, in reading order, at most `largest` pixels wide, and `shading` takes them.
JoinedHits join_hits(std::span<const CameraSample> samples, std::span<const std::uint32_t> sample_of,
                     const ShadingBatch& batch, float largest, const ObjectShading& shading, bool wraps_u);

}  // namespace redmap
