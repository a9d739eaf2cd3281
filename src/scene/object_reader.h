// The [object.NAME] tables of a scene file: surfaces, shaders and where they stand.
#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <string>

#include "scene/scene.h"
#include "scene/table_reader.h"

namespace redmap {

/// Reads objects, loading every mesh file once however many objects share it.
class ObjectReader {
 public:
  /// `scene_folder`: what paths in the file are relative to, and the parent of the maps.
  explicit ObjectReader(std::filesystem::path scene_folder) : scene_folder_(std::move(scene_folder)) {}

  /// Reads the table [object.NAME]. Throws Error.
  Object read(const std::string& name, const toml::table& table);

 private:
  std::shared_ptr<const Surface> read_surface(const TableReader& reader);
  std::shared_ptr<const Surface> load_mesh(const TableReader& reader);

  std::filesystem::path scene_folder_;
  std::map<std::filesystem::path, std::shared_ptr<const Surface>> meshes_;
};

}  // namespace redmap
