// Where a map finds its shader again. In files that is relative to the map's folder; a map in memory is nowhere yet, so
// there it is absolute.
#pragma once

#include <filesystem>

#include "map/reduction_map.h"

namespace redmap::python {

inline void make_origin_absolute(ShaderOrigin& origin, const std::filesystem::path& folder) {
  const auto absolute = [&](std::string& file) {
    file = (std::filesystem::absolute(folder / ".") / file).lexically_normal().generic_string();
  };
  if (origin.file.empty()) return;
  absolute(origin.file);
  for (auto& [name, image] : origin.images) absolute(image.path);
}

inline void make_origin_relative(ShaderOrigin& origin, const std::filesystem::path& folder) {
  const auto relative = [&](std::string& file) {
    file = std::filesystem::proximate(file, std::filesystem::absolute(folder / ".")).generic_string();
  };
  if (origin.file.empty()) return;
  relative(origin.file);
  for (auto& [name, image] : origin.images) relative(image.path);
}

}  // namespace redmap::python
