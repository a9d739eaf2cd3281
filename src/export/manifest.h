// What the files of an export say of themselves: manifest.json, for programs that read them. Not part of the public
// interface.
#pragma once

#include <functional>
#include <nlohmann/json.hpp>
#include <string>

#include "export/export.h"
#include "export/material_textures.h"

namespace redmap {

using Json = nlohmann::ordered_json;

/// Of all kinds: format, shader, map, and the materials that were fitted, with their errors.
Json manifest_of(const ExportInput& input, const std::string& kind);
Json json_of(const GltfMaterial& material);
/// The averaged material, and normals with their moments where the map has them. `add` writes a texture and returns the
/// name of its file.
void add_one_material(const ExportInput& input, const std::function<std::string(const Texture&)>& add, Json& manifest);
/// Which mask stands in which file and channel or layer, and its scale: `place` fills in the rest.
template <typename Place>
Json masks_json(const Masks& masks, const Place& place) {
  Json all = Json::array();
  for (std::size_t b = 0; b < masks.scales.size(); ++b) {
    all.push_back({{"basis", b}, {"scale", masks.scales[b]}});
    place(b, all.back());
  }
  return all;
}
/// Writes it, last.
void add_manifest(const Json& manifest, ExportFolder& folder);

}  // namespace redmap
