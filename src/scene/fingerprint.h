// A number that tells scenes apart: finished frames are only kept where nothing that decides the picture has changed.
#pragma once

#include <cstdint>

#include "scene/scene.h"

namespace redmap {

/// Hash of everything in `scene` that decides the original's picture: camera, background, lights, and the objects'
/// surfaces, shaders (their texts too), parameters and transforms; the time only where a shader varies in time. Names,
/// map paths and map sizes do not count. The same on every run and machine.
std::uint64_t scene_fingerprint(const Scene& scene);

}  // namespace redmap
