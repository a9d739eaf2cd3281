// An atlas for a mesh without uv: charts grown on the surface, each flattened by least squares conformal maps
// (Levy et al. 2002), packed as bitmaps. Charts are disks, without flips and without overlap.
#pragma once

#include <filesystem>
#include <map>
#include <string>

#include "surface/mesh.h"

namespace redmap {

struct AtlasOptions {
  int charts = 40;               ///< to start from, at least; topology and stretch add more, merging takes some back
  double max_l2_stretch = 1.25;  ///< a chart that stretches more is split (Sander et al. 2001)
  int resolution = 1024;         ///< texels across for which the gutter is sized
  int cell_texels = 4;  ///< packing grid, twice, four times ... that above 2048 texels: charts never share a cell, so
                        ///< levels up to log2(cell) are clean
  int gutter_texels = 1;
  /// Texels along a unit of length on the part (group or material) of that name, relative to the rest; above 0. Of a
  /// triangle whose group and material are both named here, that of the group. Charts end where the density changes.
  std::map<std::string, float> part_density{};
};

struct AtlasReport {
  int charts = 0;
  double l2_stretch = 0;  ///< over the whole mesh, 1 is isometric
  double packing = 0;     ///< covered part of the square
  int flips = 0;
};

/// Gives `mesh` new uv in [0, 1]^2. Throws Error if no atlas without flips or overlap is found, and on parts that the
/// mesh does not have.
AtlasReport unwrap(TriangleMesh& mesh, const AtlasOptions& options = {});

/// As unwrap(), remembered in `cache_folder` under a hash of the mesh and the options. A folder that cannot be written
/// only means that nothing is remembered.
AtlasReport unwrap_cached(TriangleMesh& mesh, const std::filesystem::path& cache_folder,
                          const AtlasOptions& options = {});

}  // namespace redmap
