// How well the shading normals of black boxes are found: reflectance models x methods, over random normals
// (docs/shading_normals.md).
#pragma once

#include <string>
#include <vector>

#include "analysis/shading_normal.h"
#include "shading_normals/reflectance_models.h"

namespace redmap::bench {

struct ShadingNormalsOptions {
  int normals = 600;              ///< random geometric normals, each with a random shading normal
  double tilt_degrees = 40;       ///< largest angle between the two; uniform over the cap, about
  bool single_precision = false;  ///< directions and radiance rounded to floats, as redmap's shaders have them
};

struct ShadingNormalsRow {
  std::string model, method;
  double median_radians = 0, p95_radians = 0;  ///< error; where none was found, that of the geometric normal
  double calls = 0;                            ///< mean
  int found = 0;                               ///< of the normals
  int wrong_reported_as_found = 0;             ///< of these, off by more than .01 rad
};

/// An error above which a normal is wrong, in radians.
inline constexpr double kWrongNormal = 0.01;

ShadingNormalsRow measure_shading_normals(const ReflectanceModel& model, NormalMethod method,
                                          const ShadingNormalsOptions& options);
/// Every model with every method.
std::vector<ShadingNormalsRow> measure_shading_normals(const ShadingNormalsOptions& options);

}  // namespace redmap::bench
