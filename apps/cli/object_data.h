// What the objects of a scene are shaded from, read or built as a method needs it.
#pragma once

#include <vector>

#include "render/renderer.h"
#include "scene/scene.h"

namespace redmap::cli {

/// Reads the reduction maps of `scene` (map, paper) and builds the pyramids of the baselines (parameters, paper).
/// Throws Error naming the command to run where a map is missing.
std::vector<ObjectData> load_object_data(const Scene& scene, Method method);

/// Builds what `method` needs besides the map: averaged parameters, or the paper's mean normals, for a map of `size`.
/// Throws Error where the object has none.
void add_baseline(const Object& object, Method method, int size, ObjectData& data);

/// The method of that name, as on the command line.
Method method_of(const std::string& name);
/// All their names, for help and checks.
std::vector<std::string> method_names();
/// Of Quality.
std::vector<std::string> quality_names();

}  // namespace redmap::cli
