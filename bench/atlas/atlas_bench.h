// What `redmap bench atlas` measures of one mesh.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include "atlas/far_error.h"
#include "surface/atlas.h"

namespace redmap::bench {

struct AtlasRow {
  std::string mesh;  ///< name of the file
  std::size_t triangles = 0;
  AtlasReport atlas;
  /// Area in uv over area on the mesh, relative to the mean: what 5 % and 95 % of the surface stay below.
  double area_q05 = 0, area_q95 = 0;
  std::size_t overlap_texels = 0;  ///< at twice the size, texels whose centre two triangles claim
  double seconds = 0;              ///< of unwrapping
  std::uint64_t peak_bytes = 0;    ///< of the process so far
  std::optional<FarError> far;
};

/// Reads a mesh and unwraps it anew for maps of `size` texels. Throws Error as read_mesh() and unwrap() do.
AtlasRow measure_atlas(const std::filesystem::path& path, int size, bool with_far_errors);

}  // namespace redmap::bench
