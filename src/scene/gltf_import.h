// Cameras and lights (KHR_lights_punctual) of glTF files, so that a scene can be laid out in a modelling program.
#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "scene/scene.h"

namespace redmap {

struct GltfImport {
  std::optional<Camera> camera;  ///< the first perspective camera; 480 pixels high, as wide as its aspect ratio asks
  std::vector<Light> lights;     ///< named after their nodes, all with shadows
};

/// Reads a glTF or GLB file. Candela and lux are taken for irradiance at distance 1 and irradiance. Meshes are read by
/// read_mesh(). Throws Error on unsound files and on lights that are neither points nor directional.
GltfImport import_gltf(const std::filesystem::path& path);

}  // namespace redmap
