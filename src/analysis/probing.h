// Asking one black box for radiance, for the searches of its shading normal (shading_normal_search.h).
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "analysis/shading_normal.h"

namespace redmap {

using Vector = Eigen::Vector3d;

inline constexpr double kRightAngle = std::numbers::pi / 2;

inline Direction to_direction(const Vector& v) { return {v.x(), v.y(), v.z()}; }
inline Vector to_vector(const Direction& d) { return {d[0], d[1], d[2]}; }

/// Polar coordinates about a unit vector.
class PolarFrame {
 public:
  explicit PolarFrame(const Vector& axis) : axis_(axis), x_(axis.unitOrthogonal()), y_(axis.cross(x_)) {}
  Vector outward(double azimuth) const { return std::cos(azimuth) * x_ + std::sin(azimuth) * y_; }
  Vector at(double polar, double azimuth) const { return std::cos(polar) * axis_ + std::sin(polar) * outward(azimuth); }

 private:
  Vector axis_, x_, y_;
};

/// One place that answers.
class Prober {
 public:
  Prober(const AskRadiance& ask, const Vector& geometric_normal, double precision)
      : geometric_normal_(geometric_normal), precision_(precision), ask_(ask) {}

  /// Radiance under each pair. Valid until the next question.
  const std::vector<double>& radiance(const std::vector<DirectionPair>& pairs) {
    radiance_.resize(pairs.size());
    ask_(pairs, radiance_);
    calls_ += static_cast<int>(pairs.size());
    return radiance_;
  }
  /// Retro-radiance R(d) = radiance(d, d): for an isotropic reflectance it depends on the angle between d and the
  /// shading normal alone.
  const std::vector<double>& retro(const std::vector<Vector>& directions) {
    pairs_.clear();
    for (const Vector& d : directions) pairs_.push_back({to_direction(d), to_direction(d)});
    const std::vector<double>& values = radiance(pairs_);
    for (const double r : values) brightest_ = std::max(brightest_, r);
    return values;
  }

  const Vector& geometric_normal() const { return geometric_normal_; }
  double precision() const { return precision_; }
  int calls() const { return calls_; }
  /// Largest retro-radiance seen.
  double brightest() const { return brightest_; }
  /// `v` or its opposite, whichever is on the outer side.
  Vector outward(const Vector& v) const { return v.dot(geometric_normal_) < 0 ? Vector(-v) : v; }

 private:
  Vector geometric_normal_;
  double precision_, brightest_ = 0;
  const AskRadiance& ask_;
  int calls_ = 0;
  std::vector<DirectionPair> pairs_;
  std::vector<double> radiance_;
};

}  // namespace redmap
