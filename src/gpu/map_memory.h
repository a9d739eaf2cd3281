// A reduction map as the renderer's shaders read it. Not part of the public interface.
#pragma once

#include <optional>

#include "gpu/frame_blocks.h"
#include "gpu/object_text.h"
#include "map/reduction_map.h"
#include "surface/surface.h"

namespace redmap {

/// Whether coverage is 1 everywhere.
template <typename Component>
bool is_covered(const Pyramid<Component>& pyramid) {
  for (int level = 0; level < pyramid.levels(); ++level)
    for (int y = 0; y < pyramid.extent(level).height; ++y)
      for (int x = 0; x < pyramid.extent(level).width; ++x)
        if (pyramid.coverage(level, x, y) < 1) return false;
  return true;
}

/// What the texts of an object with this map depend on.
void set_map_traits(const ReductionMap& map, const Surface& surface, ObjectTraits& traits);
/// The map's part of an object's block.
void set_map_block(const ReductionMap& map, bool is_fast, ObjectBlock& block);

/// Weights, four to a layer, multiplied by coverage where there is any; coverage follows the last. Level after level,
/// layer after layer, rows from v = 0 up.
struct WeightTexels {
  int layers = 0;
  std::vector<std::byte> texels;
};
WeightTexels weight_texels(const ReductionMap& map);
LayeredTexture make_weight_texture(const Device& device, const ReductionMap& map);

/// Places of the basis and their frames, lobe models, drawn normals and, where the map has them, bytes of normals, or
/// else clusters and seams of the surface, as kernels/place.glsl, lobes.glsl, normals.glsl, clusters.glsl and
/// seams.glsl lay them out.
std::vector<std::uint32_t> map_data(const ReductionMap& map, const Surface& surface, const ObjectTraits& traits);

}  // namespace redmap
