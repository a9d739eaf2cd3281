// The searches that shading_normal.cpp makes a cascade of. Each answers nothing where it notices that it failed.
#pragma once

#include <optional>

#include "analysis/probing.h"

namespace redmap {

/// Where gradients are taken: three probes `polar` radians around `axis`, by differences over `step` either side, along
/// and across the great circle from it: a difference across vanishes to all orders where the axis is the normal.
struct GradientProbe {
  Vector axis;
  double polar, step;
};
/// What they found. The normal points to either side.
struct GradientFit {
  Vector normal;
  double slope = 0;  ///< mean |dR / d polar angle|
  double level = 0;  ///< mean R
};
struct GradientSteps {
  double first, second;  ///< of the first probes, and of those around what they find
};
GradientSteps gradient_steps(double polar, double precision);
/// The 12 directions that a probe asks for, and what it makes of their retro-radiance.
std::vector<Vector> gradient_directions(const GradientProbe& probe);
std::optional<GradientFit> fit_gradients(const GradientProbe& probe, std::span<const double> radiance,
                                         double precision);
/// Nine directions on three circles about the normal, where one that is wrong by an allowed angle would show: it
/// changes R by about that angle times the slope, or, on a circle much brighter or darker than the probes, times that
/// contrast.
std::vector<Vector> symmetry_directions(const Vector& normal, double polar);
bool is_symmetric(const GradientFit& fit, double polar, std::span<const double> radiance, double precision);

/// Gradients of retro-radiance at three probes `polar` radians around `start`, and again around what they find; then
/// nine calls that verify rotational symmetry. 33 calls. For isotropic reflectances that are smooth there.
std::optional<Vector> normal_by_gradients(Prober& prober, const Vector& start, double first_polar, double polar);

/// The paper's search: the ends of what is not black on two great arcs, at right angles, from the geometric normal to
/// its opposite; bisected `steps` times each.
std::optional<Vector> normal_by_two_arcs(Prober& prober, int steps);
/// The same, verified at eight more azimuths.
std::optional<Vector> normal_by_great_arcs(Prober& prober);

/// A level of retro-radiance met on three arcs from `start`: the plane through those points is perpendicular to the
/// normal of an isotropic reflectance. Verified at eight more azimuths. For steps and plateaus.
std::optional<Vector> normal_by_circles(Prober& prober, const Vector& start);

/// Gradients about the brightest of 96 directions: for narrow lobes and nothing else.
std::optional<Vector> normal_by_lobe(Prober& prober);

/// Circles about the centroid of retro-radiance over the hemisphere.
std::optional<Vector> normal_by_centroid(Prober& prober);

/// Zickler, Belhumeur and Kriegman 2002: a reciprocal reflectance f gives f(a, b) a.n = f(b, a) b.n for radiances with
/// their cosines, one linear equation a pair. Three pairs, six calls.
std::optional<Vector> normal_by_reciprocity(Prober& prober);

}  // namespace redmap
