// How a bake on a device compares with one on the CPU: seconds, and the weights of the maps texel by texel.
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "map/reduction_map.h"
#include "surface/surface.h"

namespace redmap::bench {

/// What two maps of the same extent and size of the basis differ in, on level 0.
struct MapDifference {
  bool same_basis = false;  ///< the same number of reflectances; else nothing else counts
  double mean_weight = 0;   ///< of all weights of covered texels, in units of the largest of their channel
  std::size_t flipped = 0;  ///< covered texels with a weight or a coverage that differs by more than a step of a byte
  std::size_t covered = 0;  ///< of either map
};
MapDifference compare_maps(const ReductionMap& a, const ReductionMap& b);

struct BakeRow {
  std::string shader;
  int size = 0;
  double gpu_seconds = 0, cpu_seconds = 0;
  MapDifference difference;
};
/// Bakes a shader of the library both ways, once each. A device's seconds begin with opening it and compiling for it.
BakeRow measure_bake(const Surface& surface, const std::string& shader, int size, const std::string& device);

struct BakeRowOptions {
  std::string device;                ///< as in Device::open()
  std::string object = "bunny";      ///< as in make_bench_surface()
  std::vector<std::string> shaders;  ///< of the library; empty: all
  int size = 1024;
  std::filesystem::path models = "models";
  std::function<void(double)> progress;  ///< told the part done
  std::function<bool()> cancelled;
};
std::vector<BakeRow> measure_bakes(const BakeRowOptions& options);

}  // namespace redmap::bench
