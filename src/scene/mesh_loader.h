// From what a scene says about a mesh file to the surfaces it stands for: units, rest position, part, uv that were
// judged, one surface for each of their tiles.
#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "surface/mesh_units.h"
#include "surface/surface.h"

namespace redmap {

enum class UvChoice {
  kAuto,    ///< the file's, where they are fit to be used; otherwise new ones
  kFile,    ///< the file's, even where they overlap
  kUnwrap,  ///< new ones
};

struct MeshRequest {
  std::filesystem::path mesh;
  std::filesystem::path rest;  ///< the same mesh at rest; empty: `mesh` is at rest
  std::string part;            ///< a group or material of the file; empty: all of it
  MeshUnits units;
  UvChoice uv = UvChoice::kAuto;
  int uv_set = 0;                             ///< glTF: which TEXCOORD
  std::map<std::string, float> part_density;  ///< AtlasOptions::part_density; not empty: with new uv only
  friend bool operator==(const MeshRequest& a, const MeshRequest& b) = default;
};

struct LoadedMesh {
  struct Tile {
    int number = 0;  ///< as in uv_quality.h; 0 where the whole mesh lies in the unit square
    std::shared_ptr<const Surface> surface;
  };
  std::vector<Tile> tiles;               ///< at least one, ascending
  std::vector<std::string> remarks;      ///< one line each: what was wrong with the file, and what was done about it
  std::vector<std::string> assumptions;  ///< one line each: what the file does not say
};

/// Atlases are remembered in `cache_folder`. Throws Error.
LoadedMesh load_mesh(const MeshRequest& request, const std::filesystem::path& cache_folder);

}  // namespace redmap
