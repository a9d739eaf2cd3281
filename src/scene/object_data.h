// Whether an object has what a method shades it from.
#pragma once

#include "map/object_data.h"
#include "scene/scene.h"

namespace redmap {

/// Throws Error unless there is a map, baked for `object` as it is now.
void require_map(const Object& object, const ObjectData& data);

/// Throws Error unless the object's shader declares its material and there are averaged parameters, and slopes where it
/// perturbs normals.
void require_parameters(const Object& object, const ObjectData& data);

}  // namespace redmap
