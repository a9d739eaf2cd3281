// How the value of a pixel was found: what `redmap render --show decisions` paints (paper, Fig. 6).
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

#include "base/image.h"

namespace redmap {

/// From the cheapest to the dearest: of a pixel's samples the dearest counts.
enum class Decision : std::uint8_t {
  kBackground,    ///< no object
  kMeanNormal,    ///< looked up, and shaded about one normal
  kConvolved,     ///< looked up, and a lobe model convolved with the normals
  kDrawn,         ///< looked up, and shaded about normals drawn from their distribution
  kOriginal,      ///< the shader itself, close up
  kBlended,       ///< something of both
  kSubdivided,    ///< more rays, at silhouettes, chart seams and occlusions
  kSupersampled,  ///< jittered samples of the shader itself, since a lookup would not do
};
inline constexpr int kDecisionCount = 8;

/// Flat colour, linear, and words for people.
struct DecisionLegend {
  std::string_view label;
  Rgb color;
};
const DecisionLegend& decision_legend(Decision decision);

/// One flat colour a pixel. `decisions` are row-major.
Image paint_decisions(std::span<const Decision> decisions, int width, int height);

}  // namespace redmap
