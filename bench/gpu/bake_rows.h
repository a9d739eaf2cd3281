// How a bake on a device compares with one on the CPU: seconds, and the weights of the maps texel by texel.
#pragma once

#include <cstddef>
#include <string>

#include "map/reduction_map.h"
#include "shader/shader.h"
#include "surface/surface.h"

namespace redmap::bench {

/// What two maps of the same extent and basis size differ in, on level 0.
struct MapDifference {
  double mean_weight = 0;     ///< of all weights of covered texels, in units of the largest of their channel
  std::size_t flipped = 0;    ///< covered texels with a weight or a coverage that differs by more than 1/255
  std::size_t covered = 0;    ///< of either map
  bool same_basis = false;    ///< the same number of reflectances; else nothing else counts
  double farthest_basis = 0;  ///< distance between places of the same number, object units
};
MapDifference compare_maps(const ReductionMap& a, const ReductionMap& b);

struct BakeRow {
  std::string shader;
  int size = 0;
  double gpu_seconds = 0, cpu_seconds = 0;
  MapDifference difference;
};
/// Bakes a shader of the library both ways, once each: the device's seconds begin with its text.
BakeRow measure_bake(const Surface& surface, const std::string& shader, int size, const std::string& device);

}  // namespace redmap::bench
