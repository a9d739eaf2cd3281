// All of a reduction map but its texels, as JSON: the attribute of its file (docs/map_format.md).
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "map/reduction_map.h"

namespace redmap {

/// What a file says beside the texels.
struct MapDescription {
  ReductionMap map;                   ///< without weights
  std::vector<float> scales;          ///< of the weights
  std::vector<float> tangent_scales;  ///< of the tangents, if there are any
  bool wraps_u = false;
};

std::string describe_map(const ReductionMap& map);
/// Throws Error, beginning with `where`, on anything missing, of another version or out of range.
MapDescription parse_map_description(std::string_view json, const std::string& where);

}  // namespace redmap
