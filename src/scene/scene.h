// A scene: camera, lights, objects and how they move. Read from TOML by scene_file.h.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "base/vec.h"
#include "shader/shader.h"
#include "surface/surface.h"

namespace redmap {

/// Similarity transform object to world: rotate (Euler degrees about x, then y, then z), scale, translate.
struct Transform {
  Vec3 translate;
  Vec3 rotate_degrees;
  float scale = 1;
};

/// Perspective camera. World space, y up.
struct Camera {
  Vec3 position{0, 0, 5};
  Vec3 look_at;
  Vec3 up{0, 1, 0};
  float vertical_fov_degrees = 40;
  int width = 640, height = 480;
};

struct Light {
  enum class Type { kPoint, kDirectional };
  Type type = Type::kPoint;
  std::string name;
  Vec3 position;           ///< world; point lights
  Vec3 to_light;           ///< world, unit; directional lights
  Rgb intensity{1, 1, 1};  ///< point: irradiance at distance 1 (falls with its square); directional: irradiance
  bool shadows = true;
};

/// Object::map_size that is still to be settled (render/closest_view.h).
inline constexpr int kAutoMapSize = 0;

struct Object {
  std::string name;  ///< as the scene file calls it, and for a tile of a mesh with ".1001" or the like after it
  std::string declared_name;  ///< as the scene file calls it: the same for all tiles of a mesh
  std::shared_ptr<const Surface> surface;
  std::shared_ptr<const Shader> shader;
  std::filesystem::path map_path;  ///< where its reduction map is, or will be baked to
  int map_size = 1024;             ///< texels across, or kAutoMapSize
  float texels_per_unit = 0;       ///< with kAutoMapSize: of length in object space; 0: as the closest view needs
  Transform transform;
};

/// Everything at one moment. Tiles of a mesh follow one another.
struct Scene {
  Camera camera;
  std::vector<Light> lights;
  std::vector<Object> objects;
  Rgb background;
  float time_seconds = 0;
};

/// Whether object i is a tile of the mesh that the object before it is a tile of, too.
inline bool is_further_tile(const Scene& scene, std::size_t i) {
  const std::string& name = scene.objects[i].declared_name;
  return i > 0 && !name.empty() && name == scene.objects[i - 1].declared_name;
}

}  // namespace redmap
