#include "scene/object_data.h"

#include "base/error.h"
#include "scene/map_shader.h"

namespace redmap {

void require_map(const Object& object, const ObjectData& data) {
  if (!data.map) throw Error("object '{}' has no reduction map at {}", object.name, object.map_path.string());
  require_map_of(object, *data.map);
}

void require_parameters(const Object& object, const ObjectData& data) {
  const ShaderInfo& info = object.shader->info();
  if (!info.has_material)
    throw Error("shader '{}' does not declare material(): --method parameters needs it", info.name);
  if (info.emits) throw Error("shader '{}' emits light: --method parameters has no parameter for it", info.name);
  if (!data.parameters) throw Error("object '{}' has no averaged parameters", object.name);
  if (info.perturbs_normals && !data.slopes)
    throw Error("shader '{}' perturbs normals: --method parameters needs their slopes, found none", info.name);
}

}  // namespace redmap
