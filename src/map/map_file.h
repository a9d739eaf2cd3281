// Reduction maps on disk: one multi-part, tiled, mip-mapped OpenEXR file that any viewer opens (docs/map_format.md).
#pragma once

#include <filesystem>
#include <string_view>

#include "map/reduction_map.h"

namespace redmap {

/// Version of the file's layout; files of another are refused.
inline constexpr int kMapFormatVersion = 5;

/// Writes `map`, through a temporary name. The bytes depend on the map alone. Throws Error, also when the disk is full.
void write_map(const std::filesystem::path& path, const ReductionMap& map);

/// Reads a map exactly as it was written. Throws Error on a file that is missing, truncated, no reduction map, of
/// another version, or holds anything out of range.
ReductionMap read_map(const std::filesystem::path& path);

/// As kebab-case words, in files and for people: reduces, one-material, does-not-reduce.
std::string_view verdict_name(MapVerdict verdict);

}  // namespace redmap
