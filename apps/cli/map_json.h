// What `redmap inspect` and the file beside a baked map say about it.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "bake/bake.h"
#include "map/reduction_map.h"

namespace redmap::cli {

/// Shader, parameters, number of basis reflectances and their places, size, levels, bytes in memory, residual,
/// tolerance, verdict and its reason.
nlohmann::json map_json(const ReductionMap& map);

/// As map_json(), and what the bake took: seconds, bytes, stages, machine.
nlohmann::json bake_json(const ReductionMap& map, const BakeReport& report);

}  // namespace redmap::cli
