// The [animation] table of a scene file.
#pragma once

#include "scene/animation.h"
#include "scene/table_reader.h"

namespace redmap {

/// Reads [animation]; `scene` says which cameras, lights and objects there are to move. Throws Error on targets that
/// do not exist, values of the wrong kind, and two keys of one target at the same frame.
Animation read_animation(const toml::table& table, const Scene& scene);

}  // namespace redmap
