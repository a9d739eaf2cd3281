// Which of its assumptions a map breaks, where its error is, and why.
#pragma once

#include <array>
#include <span>
#include <string>

#include "verify/measured_pixel.h"

namespace redmap {

/// What a stage does to all pixels together.
struct StageShare {
  double rms = 0;   ///< of its contribution
  double part = 0;  ///< of the squared error: contribution times error over squared error. The parts add up to one
};
using StageShares = std::array<StageShare, kStages>;

/// Over the pixels that the map alone made.
StageShares share_error(std::span<const MeasuredPixel> pixels);

struct Diagnosis {
  Stage weakest = Stage::kFit;
  std::string reason;  ///< half a sentence for people: which assumption fails, and why
};

/// Looks at the stage with the largest part, and at its worst pixels.
Diagnosis diagnose(const PixelRenderer& renderer, const ReductionMap& map, std::span<const MeasuredPixel> pixels,
                   const StageShares& shares);

}  // namespace redmap
