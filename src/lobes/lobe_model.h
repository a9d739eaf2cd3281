// A reflectance in half-vector space: constant + cosine + Gaussians around the half vector. It stands in for a basis
// reflectance only where that is integrated over a distribution of normals (docs/normals.md); what is seen is scaled by
// the reflectance itself.
#pragma once

#include <array>

namespace redmap {

/// For light and viewer at `theta_d` degrees from their half vector h, and a normal n (offset p = n's part
/// perpendicular to h, in the plane of incidence and across it):
///   constant + cosine * max(0, n . light) + sum_k amplitude_k exp(-(p_in^2 / stretch^2 + p_across^2) / (2 s_k^2))
/// each in linear RGB, with s_k = width(k). Between the angles of the table all is interpolated linearly.
struct LobeModel {
  static constexpr int kAngles = 9;        ///< theta_d = 0 to 80 degrees
  static constexpr float kAngleStep = 10;  ///< degrees
  static constexpr int kWidths = 10;

  using Colour = std::array<float, 3>;
  struct Angle {
    Colour constant{}, cosine{};
    std::array<Colour, kWidths> amplitude{};
    float stretch = 1;
  };
  static constexpr int kAngleFloats = sizeof(Angle) / sizeof(float);

  std::array<Angle, kAngles> angles{};
  /// Largest relative error that integrals by the model had on random distributions, directions and widths; 1 or more:
  /// the model is of no use.
  float error = 1;

  /// .009 to .62, a factor of 1.6 apart: from Phong exponents of some thousands to lobes as wide as a cosine.
  static constexpr float width(int k) {
    float s = 0.009f;
    for (; k > 0; --k) s *= 1.6f;
    return s;
  }
};
static_assert(LobeModel::kAngleFloats == 3 * (2 + LobeModel::kWidths) + 1);

}  // namespace redmap
