// Whether the uv that a mesh brings can serve as an atlas: "the better the mapping, the more accurate the antialiasing"
// (paper, section 4.1), and a place in the map that belongs to two places of the surface cannot hold both.
#pragma once

#include <string>
#include <vector>

#include "surface/mesh.h"

namespace redmap {

/// Tiles as film assets number them (UDIM): 1001 + column + 10 row, the unit square being 1001.
inline constexpr int kFirstTile = 1001;

struct UvReport {
  std::vector<int> tiles;                    ///< ascending; empty where triangles lie outside every tile
  std::size_t triangles_outside = 0;         ///< in no tile (u of 0 to 10, v of 0 to 100), or across the border of one
  std::size_t covered_texels = 0;            ///< centres of 1024 x 1024 texels a tile that a triangle covers
  std::size_t overlapping_texels = 0;        ///< centres that two triangles or more cover
  std::size_t mirrored_texels = 0;           ///< of these, the ones whose triangles turn opposite ways
  double degenerate_area = 0;                ///< part of the surface whose triangles have (almost) no area in uv
  double coverage = 0;                       ///< covered part of all tiles
  double density_low = 0, density_high = 0;  ///< 5 % and 95 % of the surface have fewer texels to the unit of length
                                             ///< than this, 1 being the mean
  /// What makes the uv unusable, as "uv overlap on 3.1 % of the covered texels"; empty if they are fit to be used.
  std::string problem;
};

/// Judges the uv of `mesh`, which must have some. `resolution`: texels across a tile at which overlap is looked for.
UvReport judge_uv(const TriangleMesh& mesh, int resolution = 1024);

/// The tile of every triangle, 0 where it lies in none.
std::vector<int> tiles_of(const TriangleMesh& mesh);

/// The triangles of one tile, their uv moved to the unit square. Positions and normals are all kept.
TriangleMesh extract_tile(const TriangleMesh& mesh, int tile);

}  // namespace redmap
