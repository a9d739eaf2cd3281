// `-D object.parameter=value`: what the command line changes in a scene file, applied to the TOML before it is read.
#pragma once

#include <toml++/toml.h>
#include <span>
#include <string>

namespace redmap {

/// Merges every override into `scene`, later ones winning. "bunny.size=3" sets a shader parameter of object bunny;
/// keys that begin with camera, light, object, animation, import or background are keys of the file itself
/// ("camera.fov=20", "light.key.position=[1, 2, 3]", "object.bunny.map_size=512"). Values are TOML; whatever is no
/// TOML value is taken as text, since shells eat quotes. Throws Error naming the override.
void apply_overrides(toml::table& scene, std::span<const std::string> overrides);

}  // namespace redmap
