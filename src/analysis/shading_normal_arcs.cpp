// Shading normals from where retro-radiance crosses a level on arcs from a direction: black on great arcs (paper,
// section 4.5), or any level of an isotropic reflectance, whose directions of equal retro-radiance lie on circles.
#include <Eigen/Geometry>
#include <limits>

#include "analysis/shading_normal_search.h"

namespace redmap {
namespace {

/// A plane through the crossings is verified this far inside and outside of it, in radians: well below what may be
/// reported as found.
constexpr double kHorizonMargin = 0.004, kCircleMargin = 0.002;
/// With four, circles that were cut at the geometric horizon passed for others, up to .08 rad off.
constexpr int kCheckedAzimuths = 8;

/// Polar angles on arcs from one direction: above the level at `inside`, not above it at `outside`.
struct Bracket {
  double azimuth, inside, outside;
};

/// Halves all brackets `steps` times, and takes their middles.
void bisect(Prober& prober, const PolarFrame& frame, double level, int steps, std::vector<Bracket>& brackets) {
  std::vector<Vector> asked(brackets.size());
  for (int step = 0; step < steps; ++step) {
    for (std::size_t i = 0; i < brackets.size(); ++i)
      asked[i] = frame.at((brackets[i].inside + brackets[i].outside) / 2, brackets[i].azimuth);
    const std::vector<double>& r = prober.retro(asked);
    for (std::size_t i = 0; i < brackets.size(); ++i)
      (r[i] > level ? brackets[i].inside : brackets[i].outside) = (brackets[i].inside + brackets[i].outside) / 2;
  }
}

Vector middle(const PolarFrame& frame, const Bracket& b) { return frame.at((b.inside + b.outside) / 2, b.azimuth); }

/// Retro-radiance around a circle on which it falls to a level.
struct Crossing {
  double brightest_inside = 0;  ///< just inside
  double smallest_fall = std::numeric_limits<double>::max();
};

/// Whether the radiance falls to `level` at kCheckedAzimuths of the circle of radius `radius` about `normal`, within
/// `margin`.
std::optional<Crossing> check_circle(Prober& prober, const Vector& normal, double radius, double margin, double level) {
  const PolarFrame frame(normal);
  std::vector<Vector> asked;
  for (int k = 0; k < kCheckedAzimuths; ++k)
    for (const double side : {-margin, margin})
      asked.push_back(frame.at(radius + side, 0.4 + 2 * std::numbers::pi * k / kCheckedAzimuths));
  const std::vector<double>& r = prober.retro(asked);
  Crossing crossing;
  for (int k = 0; k < kCheckedAzimuths; ++k) {
    const double inside = r[2 * k], outside = r[2 * k + 1];
    if (!(inside > level && outside <= level)) return std::nullopt;
    crossing.brightest_inside = std::max(crossing.brightest_inside, inside);
    crossing.smallest_fall = std::min(crossing.smallest_fall, inside - outside);
  }
  return crossing;
}

/// Retro-radiance on three arcs, coarsely.
constexpr int kArcs = 3, kSamples = 12;
constexpr double kArcLength = 2.5;  ///< radians: past the horizon of every shading normal
constexpr double kSpacing = kArcLength / kSamples;
double arc_azimuth(int arc) { return 0.2 + 2 * std::numbers::pi * arc / kArcs; }

struct ArcProfile {
  double value[kArcs][kSamples + 1];
  double low, high;  ///< over the upper half
};

ArcProfile sample_arcs(Prober& prober, const PolarFrame& frame) {
  std::vector<Vector> asked{frame.at(0, 0)};
  for (int arc = 0; arc < kArcs; ++arc)
    for (int i = 1; i <= kSamples; ++i) asked.push_back(frame.at(i * kSpacing, arc_azimuth(arc)));
  const std::vector<double>& r = prober.retro(asked);
  ArcProfile profile{{}, r[0], r[0]};
  for (int arc = 0; arc < kArcs; ++arc) {
    profile.value[arc][0] = r[0];
    for (int i = 1; i <= kSamples; ++i) {
      const double value = profile.value[arc][i] = r[arc * kSamples + i];
      if (i * kSpacing < kRightAngle)
        profile.low = std::min(profile.low, value), profile.high = std::max(profile.high, value);
    }
  }
  return profile;
}

/// Where each arc first falls to `level` after its brightest sample. Empty if one never does.
std::vector<Bracket> falls_to(const ArcProfile& profile, double level) {
  std::vector<Bracket> brackets;
  for (int arc = 0; arc < kArcs; ++arc) {
    const double* v = profile.value[arc];
    int i = static_cast<int>(std::max_element(v, v + kSamples / 2 + 1) - v);
    while (i < kSamples && !(v[i] > level && v[i + 1] <= level)) ++i;
    if (i == kSamples) return {};
    brackets.push_back({arc_azimuth(arc), i * kSpacing, (i + 1) * kSpacing});
  }
  return brackets;
}

/// Light and viewer are often cut off at the geometric horizon: a circle there says nothing of the shading normal.
bool is_geometric_horizon(const Prober& prober, const Vector& normal, double radius) {
  return std::abs(radius - kRightAngle) < 0.01 && normal.cross(prober.geometric_normal()).norm() < 0.01;
}

int bisection_steps(const Prober& prober) { return prober.precision() > 1e-10 ? 18 : 24; }

struct Circle {
  Vector normal;
  double fall;  ///< of the radiance across it, at least
};

/// The circle on which the radiance falls to `level`.
std::optional<Circle> find_circle(Prober& prober, const PolarFrame& frame, const ArcProfile& profile, double level) {
  std::vector<Bracket> brackets = falls_to(profile, level);
  if (brackets.empty()) return std::nullopt;
  bisect(prober, frame, level, bisection_steps(prober), brackets);

  // The plane through the three crossings.
  const Vector a = middle(frame, brackets[0]), b = middle(frame, brackets[1]), c = middle(frame, brackets[2]);
  const Vector perpendicular = (b - a).cross(c - a);
  const double length = perpendicular.norm();
  if (!(length > 1e-9)) return std::nullopt;
  const Vector normal = prober.outward(perpendicular / length);
  const double radius = std::acos(std::clamp(normal.dot(a), -1.0, 1.0));
  if (is_geometric_horizon(prober, normal, radius)) return std::nullopt;
  const auto crossing = check_circle(prober, normal, radius, kCircleMargin, level);
  if (!crossing) return std::nullopt;
  return Circle{normal, crossing->smallest_fall};
}

}  // namespace

std::optional<Vector> normal_by_two_arcs(Prober& prober, int steps) {
  const PolarFrame frame(prober.geometric_normal());
  std::vector<Bracket> ends{{0, 0, 2 * kRightAngle}, {kRightAngle, 0, 2 * kRightAngle}};
  bisect(prober, frame, 0, steps, ends);
  const Vector normal = middle(frame, ends[0]).cross(middle(frame, ends[1]));
  const double length = normal.norm();
  if (!(length > 1e-9)) return std::nullopt;
  return prober.outward(normal / length);
}

std::optional<Vector> normal_by_great_arcs(Prober& prober) {
  const auto normal = normal_by_two_arcs(prober, bisection_steps(prober) - 2);
  if (!normal) return std::nullopt;
  const auto horizon = check_circle(prober, *normal, kRightAngle, kHorizonMargin, 0);
  if (!horizon) return std::nullopt;
  // At the geometric horizon a step is a cut, and only radiance that fades towards it tells of the shading normal.
  // Smooth reflectances leave at most a twentieth at the margin.
  const bool fades = horizon->brightest_inside <= prober.brightest() / 20;
  if (!fades && is_geometric_horizon(prober, *normal, kRightAngle)) return std::nullopt;
  return normal;
}

std::optional<Vector> normal_by_circles(Prober& prober, const Vector& start) {
  const PolarFrame frame(start);
  const ArcProfile profile = sample_arcs(prober, frame);
  if (!(profile.high - profile.low > 100 * prober.precision() * std::abs(profile.high))) return std::nullopt;
  const double range = profile.high - profile.low, agreement = prober.precision() > 1e-10 ? 1e-3 : 1e-4;
  std::optional<Vector> before;
  for (const double part : {0.5, 0.3, 0.7, 0.15, 0.93}) {
    const auto circle = find_circle(prober, frame, profile, profile.low + part * range);
    if (!circle) continue;
    // A step has one circle. Where the radiance falls smoothly any level has one, nearly, even about two normals at
    // once: two levels must agree.
    if (circle->fall > range / 10) return circle->normal;
    if (before && before->cross(circle->normal).norm() < agreement) return circle->normal;
    before = circle->normal;
  }
  return std::nullopt;
}

}  // namespace redmap
