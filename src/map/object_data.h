// What the objects of a scene are shaded from, on the CPU and on devices.
#pragma once

#include <memory>

#include "map/reduction_map.h"

namespace redmap {

/// As far as the method needs it.
struct ObjectData {
  std::shared_ptr<const ReductionMap> map;            ///< kMap and kPaper
  std::shared_ptr<const Pyramid<float>> parameters;   ///< kParameters
  std::shared_ptr<const Pyramid<float>> normals;      ///< kPaper
  std::shared_ptr<const Pyramid<float>> slopes = {};  ///< kParameters, of shaders that perturb normals
};

}  // namespace redmap
