// Reflectance models in double precision, about a known shading normal: what estimates of it are measured on.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <span>
#include <string_view>

namespace redmap::bench {

/// Unit vectors in one space.
struct ModelQuery {
  Eigen::Vector3d shading_normal, geometric_normal, to_light, to_viewer;
};

struct ReflectanceModel {
  std::string_view name;
  /// Isotropic about the shading normal, without steps, and wider than a narrow lobe alone: what takes few calls.
  bool smooth;
  std::function<double(const ModelQuery&)> radiance;
};

/// 24 models, black last.
std::span<const ReflectanceModel> reflectance_models();

/// One of them. Precondition: there is one of that name.
const ReflectanceModel& reflectance_model(std::string_view name);

}  // namespace redmap::bench
