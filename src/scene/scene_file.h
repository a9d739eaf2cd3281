// Scenes as TOML files (docs/scene.md shows one): read, checked, and resolved for any frame.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "scene/animation.h"
#include "scene/scene.h"

namespace redmap {

class SceneFile {
 public:
  /// Reads `path` with everything it names: meshes (each once; those without uv are unwrapped, remembered in maps/
  /// beside the scene), shaders, and glTF to take cameras and lights from. `overrides` are "object.parameter=value" as
  /// in overrides.h. Every frame has been checked when this returns. Throws Error naming file, line, column, key, what
  /// was expected and what was found. `device` is where shaders of the user's own run, as in Device::open().
  static SceneFile load(const std::filesystem::path& path, std::span<const std::string> overrides = {},
                        const std::string& device = "");

  const std::filesystem::path& path() const { return path_; }
  /// Frames are 1 to frame_count(); 1 for a still scene.
  int frame_count() const { return animation_.frame_count; }
  float frames_per_second() const { return animation_.frames_per_second; }

  /// The scene at `frame`; surfaces and shaders are shared between frames. Throws Error outside 1 to frame_count().
  Scene at(int frame) const;
  /// The object of that name, at rest: several where it is a mesh on several tiles of uv. Throws Error naming the
  /// nearest.
  std::vector<Object> objects(const std::string& name) const;

  /// In place of what the file says; `object` is an index into Scene::objects. kAutoMapSize leaves it open.
  void set_map_size(std::size_t object, int size) { rest_.objects[object].map_size = size; }
  void set_texels_per_unit(std::size_t object, float texels) { rest_.objects[object].texels_per_unit = texels; }

  /// One line each: what was wrong with the meshes and what was done about it, for people to know; and what their
  /// files leave unsaid.
  const std::vector<std::string>& remarks() const { return remarks_; }
  const std::vector<std::string>& assumptions() const { return assumptions_; }

 private:
  std::filesystem::path path_;
  Scene rest_;
  Animation animation_;
  std::vector<std::string> remarks_, assumptions_;
};

}  // namespace redmap
