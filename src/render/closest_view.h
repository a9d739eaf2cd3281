// Map sizes that a scene leaves open ("auto"): as fine as its pixels where the camera comes closest.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "scene/scene_file.h"

namespace redmap {

struct SettledMapSize {
  std::string object;
  int size = 0;        ///< texels across
  std::string reason;  ///< half a sentence for people: what it follows from
};

/// Puts a number in place of every map_size in `file` that is "auto" (kAutoMapSize): the smallest power of two from 16
/// to 16384 whose texels are as many a unit of length as the object asks for, or else nowhere wider than a pixel's
/// footprint, over all frames; 1024 for what no frame shows. What lies behind transparent surfaces counts as seen.
/// Returns what was settled. `stop` ends it early, leaving `file` as it is; may be empty.
std::vector<SettledMapSize> settle_map_sizes(SceneFile& file, const std::function<bool()>& stop = {});

}  // namespace redmap
