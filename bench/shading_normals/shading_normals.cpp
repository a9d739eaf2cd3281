#include "shading_normals/shading_normals.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/parallel.h"
#include "base/random.h"

namespace redmap::bench {

namespace {

using Vector = Eigen::Vector3d;

double unit_double(Random& random) { return static_cast<double>(random.next() >> 11) * 0x1p-53; }

Vector random_unit(Random& random) {
  const double z = 2 * unit_double(random) - 1, angle = 2 * std::numbers::pi * unit_double(random);
  const double r = std::sqrt(1 - z * z);
  return {r * std::cos(angle), r * std::sin(angle), z};
}

/// A direction up to `tilt` radians from `axis`.
Vector tilted(const Vector& axis, double tilt, Random& random) {
  const double polar = tilt * std::sqrt(unit_double(random)), azimuth = 2 * std::numbers::pi * unit_double(random);
  const Vector x = axis.unitOrthogonal(), y = axis.cross(x);
  return std::cos(polar) * axis + std::sin(polar) * (std::cos(azimuth) * x + std::sin(azimuth) * y);
}

Vector rounded(const Direction& d, bool single) {
  const Vector v(d[0], d[1], d[2]);
  return single ? v.cast<float>().cast<double>() : v;
}

struct Trial {
  double error = 0;
  NormalEstimate estimate;
};

Trial run_trial(const ReflectanceModel& model, NormalMethod method, const ShadingNormalsOptions& options,
                std::uint64_t seed) {
  Random random(seed);
  ModelQuery query;
  query.geometric_normal = random_unit(random);
  query.shading_normal = tilted(query.geometric_normal, options.tilt_degrees * std::numbers::pi / 180, random);
  const AskRadiance ask = [&](std::span<const DirectionPair> pairs, std::span<double> radiance) {
    for (std::size_t i = 0; i < pairs.size(); ++i) {
      query.to_light = rounded(pairs[i].to_light, options.single_precision);
      query.to_viewer = rounded(pairs[i].to_viewer, options.single_precision);
      const double value = model.radiance(query);
      radiance[i] = options.single_precision ? static_cast<double>(static_cast<float>(value)) : value;
    }
  };
  const Vector g = query.geometric_normal;
  Trial trial;
  trial.estimate = estimate_shading_normal(ask, {g.x(), g.y(), g.z()}, method,
                                           options.single_precision ? kFloatPrecision : kDoublePrecision);
  const Vector found(trial.estimate.normal[0], trial.estimate.normal[1], trial.estimate.normal[2]);
  trial.error = std::atan2(found.cross(query.shading_normal).norm(), found.dot(query.shading_normal));
  return trial;
}

}  // namespace

ShadingNormalsRow measure_shading_normals(const ReflectanceModel& model, NormalMethod method,
                                          const ShadingNormalsOptions& options) {
  constexpr std::uint64_t kSeed = 29;
  std::vector<Trial> trials(static_cast<std::size_t>(options.normals));
  parallel_for(trials.size(), [&](std::size_t i) { trials[i] = run_trial(model, method, options, hash64(kSeed, i)); });

  ShadingNormalsRow row;
  row.model = model.name, row.method = label(method);
  std::vector<double> errors;
  for (const Trial& trial : trials) {
    errors.push_back(trial.error);
    row.calls += trial.estimate.calls;
    row.found += trial.estimate.found;
    row.wrong_reported_as_found += trial.estimate.found && !(trial.error <= kWrongNormal);
  }
  if (errors.empty()) return row;
  row.calls /= static_cast<double>(errors.size());
  std::ranges::sort(errors);
  row.median_radians = errors[errors.size() / 2];
  row.p95_radians = errors[errors.size() * 95 / 100];
  return row;
}

std::vector<ShadingNormalsRow> measure_shading_normals(const ShadingNormalsOptions& options) {
  std::vector<ShadingNormalsRow> rows;
  for (const ReflectanceModel& model : reflectance_models())
    for (const NormalMethod method : {NormalMethod::kCascade, NormalMethod::kGreatArc, NormalMethod::kReciprocity})
      rows.push_back(measure_shading_normals(model, method, options));
  return rows;
}

}  // namespace redmap::bench
