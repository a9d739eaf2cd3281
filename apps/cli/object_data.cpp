#include "object_data.h"

#include <algorithm>

#include "bake/baselines.h"
#include "base/error.h"
#include "map/map_file.h"

namespace redmap::cli {

std::vector<ObjectData> load_object_data(const Scene& scene, Method method) {
  std::vector<ObjectData> data(scene.objects.size());
  for (std::size_t i = 0; i < data.size(); ++i) {
    const Object& object = scene.objects[i];
    const ShaderInfo& shader = object.shader->info();
    if (method == Method::kParameters && shader.has_material) {
      data[i].parameters = std::make_shared<const Pyramid<float>>(
          build_parameter_pyramid(*object.surface, *object.shader, object.map_size));
      if (shader.perturbs_normals)
        data[i].slopes = std::make_shared<const Pyramid<float>>(
            build_slope_pyramid(*object.surface, *object.shader, object.map_size));
    }
    if (method != Method::kMap && method != Method::kPaper) continue;
    if (!std::filesystem::exists(object.map_path))
      throw Error("object '{}' has no reduction map at {}: run `redmap bake` on the scene first", object.name,
                  object.map_path.string());
    data[i].map = std::make_shared<const ReductionMap>(read_map(object.map_path));
    // The paper's mean normals are stored with the map, which knows the mesh at rest only.
    if (method == Method::kPaper && object.surface->pose_fingerprint() != object.surface->fingerprint())
      throw Error("object '{}' is deformed (rest_mesh): method paper stores normals at rest, use another", object.name);
    if (method == Method::kPaper)
      data[i].normals = std::make_shared<const Pyramid<float>>(
          build_normal_pyramid(*object.surface, *object.shader, data[i].map->size));
  }
  return data;
}

Method method_of(const std::string& name) {
  const auto found = std::find(std::begin(kMethodNames), std::end(kMethodNames), name);
  if (found == std::end(kMethodNames)) throw Error("there is no method '{}'", name);
  return static_cast<Method>(found - std::begin(kMethodNames));
}

std::vector<std::string> method_names() { return {std::begin(kMethodNames), std::end(kMethodNames)}; }

}  // namespace redmap::cli
