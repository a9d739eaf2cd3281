// Shading normals from gradients of retro-radiance. For an isotropic reflectance R(d) depends on d.n alone, so that its
// gradient on the sphere lies in the plane of d and n: d x grad R is perpendicular to n.
#include <Eigen/Eigenvalues>

#include "analysis/shading_normal_search.h"

namespace redmap {
namespace {

constexpr int kProbes = 3;
/// Azimuths of the probes and of the verification, apart so that one does not repeat the other.
constexpr double kProbeAzimuth = 0.3, kVerifyAzimuth = 0.7;
constexpr double kThird = 2 * std::numbers::pi / kProbes;

/// What three probes found.
struct GradientFit {
  Vector normal;
  double slope = 0;  ///< mean |dR / d polar angle|
  double level = 0;  ///< mean R
};

/// Central differences at three probes `polar` radians around `axis`, along and across the great circle from it: a
/// difference across vanishes to all orders where the axis is the normal.
std::optional<GradientFit> fit_gradients(Prober& prober, const Vector& axis, double polar, double step) {
  const PolarFrame frame(axis);
  std::vector<Vector> asked;
  for (int k = 0; k < kProbes; ++k) {
    const double azimuth = kProbeAzimuth + k * kThird;
    const Vector centre = frame.at(polar, azimuth), across = frame.outward(azimuth + kRightAngle);
    for (const double s : {step, -step}) asked.push_back(frame.at(polar + s, azimuth));
    for (const double s : {step, -step}) asked.push_back(std::cos(s) * centre + std::sin(s) * across);
  }
  const std::vector<double>& r = prober.retro(asked);

  // The normal is what is most nearly perpendicular to all d x grad R. Probes that touch black say nothing.
  GradientFit fit;
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
  int used = 0;
  for (int k = 0; k < kProbes; ++k) {
    const double* at = &r[4 * k];
    if (at[0] == 0 || at[1] == 0 || at[2] == 0 || at[3] == 0) continue;
    const double azimuth = kProbeAzimuth + k * kThird;
    const Vector centre = frame.at(polar, azimuth), along = frame.at(polar + kRightAngle, azimuth);
    const Vector gradient =
        (along * (at[0] - at[1]) + frame.outward(azimuth + kRightAngle) * (at[2] - at[3])) / (2 * step);
    // A gradient below the rounding of the differences is no gradient.
    const double length = gradient.norm(), level = (at[0] + at[1]) / 2;
    if (!(length * step > 10 * prober.precision() * std::abs(level))) continue;
    const Vector perpendicular = centre.cross(gradient) / length;
    sum += perpendicular * perpendicular.transpose();
    fit.slope += std::abs(gradient.dot(along)), fit.level += level;
    ++used;
  }
  if (used < 2) return std::nullopt;
  fit.slope /= used, fit.level /= used;
  fit.normal = prober.outward(Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(sum).eigenvectors().col(0));
  return fit;
}

/// Whether R is the same at three azimuths on three circles about the normal, where a normal that is wrong by an angle
/// of `allowed` would show: it changes R by about that angle times the slope, or, on a circle much brighter or darker
/// than the probes, times that contrast.
bool is_symmetric(Prober& prober, const GradientFit& fit, double polar) {
  const double allowed = prober.precision() > 1e-10 ? 1e-3 : 1e-4;
  const PolarFrame frame(fit.normal);
  std::vector<Vector> asked;
  // Inside and outside the circle of the probes, which were seen to agree already.
  const double circles[] = {0.27 * polar, 0.78 * polar, 1.67 * polar};
  for (const double circle : circles)
    for (int k = 0; k < kProbes; ++k) asked.push_back(frame.at(circle, kVerifyAzimuth + k * kThird));
  const std::vector<double>& r = prober.retro(asked);
  for (int c = 0; c < 3; ++c) {
    const double *begin = &r[c * kProbes], *end = begin + kProbes;
    const auto [low, high] = std::minmax_element(begin, end);
    const double contrast = std::abs((*low + *high) / 2 - fit.level);
    if (!(*low > 0)) return false;  // black all around is symmetric too
    if (!(*high - *low <= allowed * (fit.slope * std::min(1.0, polar / 0.45) + contrast))) return false;
  }
  return true;
}

}  // namespace

std::optional<Vector> normal_by_gradients(Prober& prober, const Vector& start, double first_polar, double polar) {
  // Differences balance rounding against curvature. The second ones have no error of curvature and may be wider.
  const double scale = std::min(1.0, polar / 0.45);
  const double first_step = scale * std::cbrt(prober.precision()), step = scale * std::pow(prober.precision(), 0.2);
  const auto coarse = fit_gradients(prober, start, first_polar, first_step);
  if (!coarse) return std::nullopt;
  const auto fine = fit_gradients(prober, coarse->normal, polar, step);
  if (!fine || !is_symmetric(prober, *fine, polar)) return std::nullopt;
  return fine->normal;
}

}  // namespace redmap
