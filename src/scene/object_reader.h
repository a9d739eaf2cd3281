// The [object.NAME] tables of a scene file: surfaces, shaders and where they stand.
#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "scene/mesh_loader.h"
#include "scene/scene.h"
#include "scene/table_reader.h"

namespace redmap {

/// Reads objects, loading every mesh once however many objects share it.
class ObjectReader {
 public:
  /// `scene_folder`: what paths in the file are relative to, and the parent of the maps. `device`: where shaders of the
  /// user's own run.
  ObjectReader(std::filesystem::path scene_folder, std::string device)
      : scene_folder_(std::move(scene_folder)), device_(std::move(device)) {}

  /// Reads the table [object.NAME]: one object, or one for each tile of a mesh whose uv spread over several. Throws
  /// Error.
  std::vector<Object> read(const std::string& name, const toml::table& table);

  /// What was said about the meshes: see LoadedMesh.
  const std::vector<std::string>& remarks() const { return remarks_; }
  const std::vector<std::string>& assumptions() const { return assumptions_; }

 private:
  std::vector<LoadedMesh::Tile> read_surfaces(const TableReader& reader);
  std::vector<LoadedMesh::Tile> read_mesh_surfaces(const TableReader& reader);

  std::filesystem::path scene_folder_;
  std::string device_;
  std::vector<std::pair<MeshRequest, std::vector<LoadedMesh::Tile>>> meshes_;
  std::vector<std::string> remarks_, assumptions_;
};

}  // namespace redmap
