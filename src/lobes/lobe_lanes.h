// Closed-form integrals of a LobeModel over Gaussian distributions of normals, eight at a time.
//
// A distribution is a Gaussian of the normal's x and y in the shading frame. On the plane perpendicular to the half
// vector it becomes another Gaussian, and its product with each of the model's has an integral in closed form.
#pragma once

#include <array>

#include "base/lanes.h"
#include "lobes/lobe_limits.h"
#include "lobes/lobe_model.h"

namespace redmap {

struct Vec3Lanes {
  lanes::Float x, y, z;
};

/// Gaussian distributions of unit normals (x, y, sqrt(1 - x^2 - y^2)) in a frame.
struct NormalLanes {
  lanes::Float x, y;        ///< mean
  lanes::Float xx, xy, yy;  ///< covariance
};

/// Light and viewer about their half vector, all in one frame.
struct HalfVectorLanes {
  Vec3Lanes half, in_plane, across;  ///< orthonormal; `in_plane` towards the light
  Vec3Lanes to_light;
  lanes::Float theta_degrees;  ///< between half vector and light
};
HalfVectorLanes half_vector(Vec3Lanes to_light, Vec3Lanes to_viewer);

/// Which Gaussians of a model count at any angle: the others are skipped.
using WidthsInUse = std::array<bool, LobeModel::kWidths>;
WidthsInUse widths_in_use(const LobeModel& model);
/// Width of the narrowest Gaussian that makes up, with those narrower, a quarter of a highlight's peak; the
/// widest there is where there is no highlight.
float narrowest_width(const LobeModel& model);

/// Models off by more than this on random distributions are not used.
inline constexpr float kTrustedError = 0.2f;
/// A reflectance that no model fits is taken for one this narrow.
inline constexpr float kNarrowestUnknown = 0.1f;
/// narrowest_width(), or kNarrowestUnknown.
float narrowest_highlight(const LobeModel& model);

/// A model at some angle. Amplitudes of widths that are not in use may be anything.
struct LobeLanes {
  std::array<lanes::Float, 3> constant, cosine;
  std::array<std::array<lanes::Float, 3>, LobeModel::kWidths> amplitude;
  lanes::Float stretch;
};
LobeLanes lobes_at(const LobeModel& model, const WidthsInUse& in_use, lanes::Float theta_degrees);
/// Lane `lane` of either in all lanes.
LobeLanes broadcast(const LobeLanes& lobes, const WidthsInUse& in_use, std::size_t lane);
HalfVectorLanes broadcast(const HalfVectorLanes& half, std::size_t lane);

/// Sums over distributions, each multiplied by a weight.
struct LobeSums {
  std::array<lanes::Float, LobeModel::kWidths> gaussian{};  ///< integrals of the Gaussians, amplitude 1
  lanes::Float cosine = 0.0f;                               ///< of max(0, n . light)
  /// Mean offset from the half vector of the normals that highlights come from, times their brightness.
  lanes::Float in_plane = 0.0f, across = 0.0f, brightness = 0.0f;
  lanes::Float spread = 0.0f;                      ///< of the brightness, what comes of the distributions' widths
  lanes::Float weight = 0.0f, x = 0.0f, y = 0.0f;  ///< of the weights, and of the means times these
};
void add_distribution(const WidthsInUse& in_use, const LobeLanes& lobes, const HalfVectorLanes& half,
                      const NormalLanes& normals, lanes::Float weight, LobeSums& sums);

/// The model's highlights and the rest: for sums, and for one normal.
struct LobeValue {
  std::array<lanes::Float, 3> highlight, smooth;
};
/// Of sums: not divided by their weight.
LobeValue integral(const WidthsInUse& in_use, const LobeLanes& lobes, const LobeSums& sums);
LobeValue at_normal(const WidthsInUse& in_use, const LobeLanes& lobes, const HalfVectorLanes& half, Vec3Lanes normal);
/// The normal that most of a sum's highlight comes from.
Vec3Lanes brightest_normal(const HalfVectorLanes& half, const LobeSums& sums);

using ColourLanes = std::array<lanes::Float, 3>;
/// What the reflectance itself has at a normal corrects the model's integral. At the brightest normal: its highlight is
/// scaled, up to twice.
ColourLanes calibrated(const LobeValue& whole, const LobeValue& model_there, const ColourLanes& reflectance_there);
/// At the mean normal, there already multiplied by the `weight` of the whole: the model gives only the difference that
/// the spread of the normals makes.
ColourLanes corrected(const LobeValue& whole, const LobeValue& model_there, const ColourLanes& reflectance_there,
                      lanes::Float weight);
/// Which of the two to take, 0 (corrected) to 1 (calibrated): by how much the spread of the normals changes the
/// highlight.
lanes::Float calibrated_part(const LobeSums& sums, const LobeValue& whole, const LobeValue& model_at_mean);

}  // namespace redmap
