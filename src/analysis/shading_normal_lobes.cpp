// Shading normals of reflectances that answer in few directions, and by reciprocity.
#include <Eigen/Geometry>

#include "analysis/shading_normal_search.h"

namespace redmap {
namespace {

/// `count` directions about `axis`, spread evenly over the cap whose height is `height`: a Fibonacci lattice.
std::vector<Vector> spread_directions(const Vector& axis, int count, double height) {
  const double golden_angle = std::numbers::pi * (3 - std::sqrt(5.0));
  const PolarFrame frame(axis);
  std::vector<Vector> directions;
  for (int i = 0; i < count; ++i)
    directions.push_back(frame.at(std::acos(1 - (i + 0.5) / count * height), i * golden_angle));
  return directions;
}

/// Near enough, the side of an anisotropic lobe looks symmetric too. Away from a narrow one there is nothing, or the
/// same all around.
bool is_symmetric_far_out(Prober& prober, const Vector& normal, double brightest) {
  constexpr double kCircles[] = {0.12, 0.35};
  constexpr int kAzimuths = 5;
  constexpr double kAllowed = 0.02, kNothing = 1e-4;  // of the brightest on the circle, and of all
  const PolarFrame frame(normal);
  std::vector<Vector> asked;
  for (const double circle : kCircles)
    for (int k = 0; k < kAzimuths; ++k) asked.push_back(frame.at(circle, 2 * std::numbers::pi * k / kAzimuths));
  const std::vector<double>& r = prober.retro(asked);
  for (std::size_t c = 0; c < std::size(kCircles); ++c) {
    const auto [low, high] = std::minmax_element(&r[c * kAzimuths], &r[c * kAzimuths] + kAzimuths);
    if (*high - *low > kAllowed * *high + kNothing * brightest) return false;
  }
  return true;
}

}  // namespace

std::optional<Vector> normal_by_lobe(Prober& prober) {
  // Up to 63 degrees from the geometric normal, .19 rad apart.
  const std::vector<Vector> directions = spread_directions(prober.geometric_normal(), 96, 0.55);
  const std::vector<double>& r = prober.retro(directions);
  const auto brightest = std::max_element(r.begin(), r.end());
  if (!(*brightest > 0)) return std::nullopt;
  const Vector start = directions[static_cast<std::size_t>(brightest - r.begin())];
  const std::optional<Vector> normal = normal_by_gradients(prober, start, 0.02, 0.03);
  return normal && is_symmetric_far_out(prober, *normal, *brightest) ? normal : std::nullopt;
}

std::optional<Vector> normal_by_centroid(Prober& prober) {
  const std::vector<Vector> directions = spread_directions(prober.geometric_normal(), 64, 1);
  const std::vector<double>& r = prober.retro(directions);
  const double darkest = *std::min_element(r.begin(), r.end());
  Vector sum = Vector::Zero();
  for (std::size_t i = 0; i < directions.size(); ++i) sum += directions[i] * (r[i] - darkest);
  const double length = sum.norm();
  if (!(length > 1e-12)) return std::nullopt;
  return normal_by_circles(prober, sum / length);
}

std::optional<Vector> normal_by_reciprocity(Prober& prober) {
  // Three directions .35 rad around the geometric normal, exchanged two by two.
  const PolarFrame frame(prober.geometric_normal());
  Vector corner[3];
  for (int k = 0; k < 3; ++k) corner[k] = frame.at(0.35, 2 * std::numbers::pi * k / 3);
  std::vector<DirectionPair> pairs;
  for (int k = 0; k < 3; ++k) {
    const Direction a = to_direction(corner[k]), b = to_direction(corner[(k + 1) % 3]);
    pairs.insert(pairs.end(), {{a, b}, {b, a}});
  }
  const std::vector<double>& r = prober.radiance(pairs);

  // Each exchange of light and viewer gives one vector perpendicular to the normal.
  std::vector<Vector> perpendicular;
  for (int k = 0; k < 3; ++k) {
    const Vector v = corner[(k + 1) % 3] * r[2 * k] - corner[k] * r[2 * k + 1];
    if (v.norm() > 1e-12) perpendicular.push_back(v.normalized());
  }
  Vector sum = Vector::Zero();
  for (std::size_t i = 0; i < perpendicular.size(); ++i)
    for (std::size_t j = i + 1; j < perpendicular.size(); ++j)
      sum += prober.outward(perpendicular[i].cross(perpendicular[j]));
  const double length = sum.norm();
  if (!(length > 1e-9)) return std::nullopt;
  return Vector(sum / length);
}

}  // namespace redmap
