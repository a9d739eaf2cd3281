#include "object_data.h"

#include <algorithm>

#include "bake/baselines.h"
#include "base/error.h"
#include "map/map_file.h"

namespace redmap::cli {

void add_baseline(const Object& object, Method method, int size, ObjectData& data) {
  const auto shared = [](Pyramid<float> pyramid) { return std::make_shared<const Pyramid<float>>(std::move(pyramid)); };
  const Surface& surface = *object.surface;
  const Shader& shader = *object.shader;
  if (method == Method::kParameters && shader.info().has_material) {
    data.parameters = shared(build_parameter_pyramid(surface, shader, size));
    if (shader.info().perturbs_normals) data.slopes = shared(build_slope_pyramid(surface, shader, size));
  }
  if (method != Method::kPaper) return;
  // The paper's mean normals are stored with the map, which knows the mesh at rest only.
  if (surface.pose_fingerprint() != surface.fingerprint())
    throw Error("object '{}' is deformed (rest_mesh): method paper stores normals at rest, use another", object.name);
  data.normals = shared(build_normal_pyramid(surface, shader, size));
}

std::vector<ObjectData> load_object_data(const Scene& scene, Method method) {
  std::vector<ObjectData> data(scene.objects.size());
  for (std::size_t i = 0; i < data.size(); ++i) {
    const Object& object = scene.objects[i];
    int size = object.map_size;
    if (method == Method::kMap || method == Method::kPaper) {
      if (!std::filesystem::exists(object.map_path))
        throw Error("object '{}' has no reduction map at {}: run `redmap bake` on the scene first", object.name,
                    object.map_path.string());
      data[i].map = std::make_shared<const ReductionMap>(read_map(object.map_path));
      size = data[i].map->size;
    }
    add_baseline(object, method, size, data[i]);
  }
  return data;
}

Method method_of(const std::string& name) {
  const auto found = std::find(std::begin(kMethodNames), std::end(kMethodNames), name);
  if (found == std::end(kMethodNames)) throw Error("there is no method '{}'", name);
  return static_cast<Method>(found - std::begin(kMethodNames));
}

std::vector<std::string> quality_names() { return {std::begin(kQualityNames), std::end(kQualityNames)}; }

std::vector<std::string> method_names() { return {std::begin(kMethodNames), std::end(kMethodNames)}; }

}  // namespace redmap::cli
