#include "scene/gltf_import.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "base/error.h"
#include "surface/gltf_document.h"

namespace redmap {

namespace {

constexpr int kDeepestNode = 256;  // deeper than any sound scene; a cycle of nodes ends here
constexpr int kPictureHeight = 480;
constexpr const char* kLightsExtension = "KHR_lights_punctual";

Vec3 to_vec3(const Eigen::Vector3d& v) {
  return {static_cast<float>(v.x()), static_cast<float>(v.y()), static_cast<float>(v.z())};
}

Eigen::Affine3d transform_of(const tinygltf::Node& node) {
  Eigen::Affine3d transform = Eigen::Affine3d::Identity();
  if (node.matrix.size() == 16) {
    transform.matrix() = Eigen::Map<const Eigen::Matrix4d>(node.matrix.data());
    return transform;
  }
  const auto &t = node.translation, &r = node.rotation, &s = node.scale;
  if (t.size() == 3) transform.translate(Eigen::Vector3d(t[0], t[1], t[2]));
  if (r.size() == 4) transform.rotate(Eigen::Quaterniond(r[3], r[0], r[1], r[2]).normalized());
  if (s.size() == 3) transform.scale(Eigen::Vector3d(s[0], s[1], s[2]));
  return transform;
}

class Importer {
 public:
  Importer(const std::filesystem::path& path, const tinygltf::Model& model) : path_(path), model_(model) {}

  GltfImport import() {
    if (model_.scenes.empty()) return result_;
    const int scene = std::max(model_.defaultScene, 0);
    for (int node : at(model_.scenes, scene, "scene").nodes) add_node(node, Eigen::Affine3d::Identity(), 0);
    return result_;
  }

 private:
  template <typename T>
  const T& at(const std::vector<T>& items, int index, const char* what) const {
    if (index < 0 || index >= static_cast<int>(items.size()))
      throw Error("{}: expected a {} index below {}, found {}", path_.string(), what, items.size(), index);
    return items[static_cast<std::size_t>(index)];
  }

  void add_node(int index, const Eigen::Affine3d& parent, int depth) {
    if (depth > kDeepestNode)
      throw Error("{}: expected nodes at most {} deep, found a cycle or more", path_.string(), kDeepestNode);
    const tinygltf::Node& node = at(model_.nodes, index, "node");
    const Eigen::Affine3d to_world = parent * transform_of(node);
    if (node.camera >= 0 && !result_.camera) add_camera(at(model_.cameras, node.camera, "camera"), node.name, to_world);
    const auto light = node.extensions.find(kLightsExtension);
    if (light != node.extensions.end())
      add_light(at(model_.lights, light->second.Get("light").GetNumberAsInt(), "light"), node.name, to_world);
    for (int child : node.children) add_node(child, to_world, depth + 1);
  }

  /// glTF cameras look along their -z with y up.
  void add_camera(const tinygltf::Camera& source, const std::string& node_name, const Eigen::Affine3d& to_world) {
    if (source.type != "perspective") return;
    const double fov = source.perspective.yfov, aspect = source.perspective.aspectRatio;
    if (!(fov > 0 && fov < std::numbers::pi))
      throw Error("{}: camera \"{}\": expected yfov above 0 and below pi, found {}", path_.string(), node_name, fov);
    Camera camera;
    camera.position = to_vec3(to_world.translation());
    camera.look_at = to_vec3(to_world * Eigen::Vector3d(0, 0, -1));
    camera.up = to_vec3(to_world.linear() * Eigen::Vector3d(0, 1, 0));
    camera.vertical_fov_degrees = static_cast<float>(fov * 180 / std::numbers::pi);
    camera.height = kPictureHeight;
    if (aspect > 0) camera.width = std::max(1, static_cast<int>(std::lround(kPictureHeight * std::min(aspect, 16.0))));
    result_.camera = camera;
  }

  /// Directional lights shine along their -z.
  void add_light(const tinygltf::Light& source, const std::string& node_name, const Eigen::Affine3d& to_world) {
    if (source.type != "point" && source.type != "directional")
      throw Error("{}: light \"{}\": expected type point or directional, found {}", path_.string(), node_name,
                  source.type);
    Light light;
    light.type = source.type == "point" ? Light::Type::kPoint : Light::Type::kDirectional;
    light.name = node_name.empty() ? fmt::format("light{}", result_.lights.size()) : node_name;
    light.position = to_vec3(to_world.translation());
    light.to_light = to_vec3((to_world.linear() * Eigen::Vector3d(0, 0, 1)).normalized());
    const Rgb color = source.color.size() == 3
                          ? Rgb{static_cast<float>(source.color[0]), static_cast<float>(source.color[1]),
                                static_cast<float>(source.color[2])}
                          : Rgb{1, 1, 1};
    light.intensity = color * static_cast<float>(source.intensity);
    const Rgb& i = light.intensity;
    if (!std::isfinite(length(light.position)) || !std::isfinite(i.r + i.g + i.b) || !(std::min({i.r, i.g, i.b}) >= 0))
      throw Error(
          "{}: light \"{}\": expected a finite place and an intensity from 0, found position [{}, {}, {}] and "
          "intensity [{}, {}, {}]",
          path_.string(), node_name, light.position.x, light.position.y, light.position.z, i.r, i.g, i.b);
    result_.lights.push_back(light);
  }

  const std::filesystem::path& path_;
  const tinygltf::Model& model_;
  GltfImport result_;
};

}  // namespace

GltfImport import_gltf(const std::filesystem::path& path) {
  const tinygltf::Model model = load_gltf(path, path.extension() == ".glb");
  return Importer(path, model).import();
}

}  // namespace redmap
