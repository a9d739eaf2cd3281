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

}  // namespace

std::vector<Vector> gradient_directions(const GradientProbe& probe) {
  const PolarFrame frame(probe.axis);
  std::vector<Vector> asked;
  for (int k = 0; k < kProbes; ++k) {
    const double azimuth = kProbeAzimuth + k * kThird;
    const Vector centre = frame.at(probe.polar, azimuth), across = frame.outward(azimuth + kRightAngle);
    for (const double s : {probe.step, -probe.step}) asked.push_back(frame.at(probe.polar + s, azimuth));
    for (const double s : {probe.step, -probe.step}) asked.push_back(std::cos(s) * centre + std::sin(s) * across);
  }
  return asked;
}

std::optional<GradientFit> fit_gradients(const GradientProbe& probe, std::span<const double> radiance,
                                         double precision) {
  // The normal is what is most nearly perpendicular to all d x grad R. Probes that touch black say nothing.
  const PolarFrame frame(probe.axis);
  GradientFit fit;
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
  int used = 0;
  for (int k = 0; k < kProbes; ++k) {
    const double* at = &radiance[4 * k];
    if (at[0] == 0 || at[1] == 0 || at[2] == 0 || at[3] == 0) continue;
    const double azimuth = kProbeAzimuth + k * kThird;
    const Vector centre = frame.at(probe.polar, azimuth), along = frame.at(probe.polar + kRightAngle, azimuth);
    const Vector gradient =
        (along * (at[0] - at[1]) + frame.outward(azimuth + kRightAngle) * (at[2] - at[3])) / (2 * probe.step);
    // A gradient below the rounding of the differences is no gradient.
    const double length = gradient.norm(), level = (at[0] + at[1]) / 2;
    if (!(length * probe.step > 10 * precision * std::abs(level))) continue;
    const Vector perpendicular = centre.cross(gradient) / length;
    sum += perpendicular * perpendicular.transpose();
    fit.slope += std::abs(gradient.dot(along)), fit.level += level;
    ++used;
  }
  if (used < 2) return std::nullopt;
  fit.slope /= used, fit.level /= used;
  fit.normal = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(sum).eigenvectors().col(0);
  return fit;
}

std::vector<Vector> symmetry_directions(const Vector& normal, double polar) {
  const PolarFrame frame(normal);
  std::vector<Vector> asked;
  // Inside and outside the circle of the probes, which were seen to agree already.
  for (const double circle : {0.27 * polar, 0.78 * polar, 1.67 * polar})
    for (int k = 0; k < kProbes; ++k) asked.push_back(frame.at(circle, kVerifyAzimuth + k * kThird));
  return asked;
}

bool is_symmetric(const GradientFit& fit, double polar, std::span<const double> radiance, double precision) {
  const double allowed = precision > 1e-10 ? 1e-3 : 1e-4;
  for (int c = 0; c < 3; ++c) {
    const double *begin = &radiance[c * kProbes], *end = begin + kProbes;
    const auto [low, high] = std::minmax_element(begin, end);
    const double contrast = std::abs((*low + *high) / 2 - fit.level);
    if (!(*low > 0)) return false;  // black all around is symmetric too
    if (!(*high - *low <= allowed * (fit.slope * std::min(1.0, polar / 0.45) + contrast))) return false;
  }
  return true;
}

GradientSteps gradient_steps(double polar, double precision) {
  // Differences balance rounding against curvature. The second ones have no error of curvature and may be wider.
  const double scale = std::min(1.0, polar / 0.45);
  return {scale * std::cbrt(precision), scale * std::pow(precision, 0.2)};
}

std::optional<Vector> normal_by_gradients(Prober& prober, const Vector& start, double first_polar, double polar) {
  const GradientSteps steps = gradient_steps(polar, prober.precision());
  const auto fit = [&](const GradientProbe& probe) {
    auto found = fit_gradients(probe, prober.retro(gradient_directions(probe)), prober.precision());
    if (found) found->normal = prober.outward(found->normal);
    return found;
  };
  const auto coarse = fit({start, first_polar, steps.first});
  if (!coarse) return std::nullopt;
  const auto fine = fit({coarse->normal, polar, steps.second});
  if (!fine) return std::nullopt;
  const std::vector<double>& around = prober.retro(symmetry_directions(fine->normal, polar));
  return is_symmetric(*fine, polar, around, prober.precision()) ? std::optional(fine->normal) : std::nullopt;
}

}  // namespace redmap
