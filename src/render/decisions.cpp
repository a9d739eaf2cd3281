#include "render/decisions.h"

#include <array>

namespace redmap {

const DecisionLegend& decision_legend(Decision decision) {
  // Cold colours for what is cheap, warm ones for what is dear.
  static constexpr std::array<DecisionLegend, kDecisionCount> kLegend{{
      {"background", {0.02f, 0.02f, 0.02f}},
      {"mean normal", {0.05f, 0.2f, 0.6f}},
      {"convolved with the normals", {0.05f, 0.45f, 0.3f}},
      {"drawn normals", {0.45f, 0.1f, 0.5f}},
      {"original, close up", {0.6f, 0.6f, 0.6f}},
      {"blended with the original", {0.25f, 0.45f, 0.65f}},
      {"subdivided at an edge", {0.8f, 0.6f, 0.05f}},
      {"supersampled", {0.7f, 0.05f, 0.03f}},
  }};
  return kLegend[static_cast<std::size_t>(decision)];
}

Image paint_decisions(std::span<const Decision> decisions, int width, int height) {
  Image image(width, height, 3);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      image.set_rgb(x, y, decision_legend(decisions[static_cast<std::size_t>(y) * width + x]).color);
  return image;
}

}  // namespace redmap
