// Material parameters evaluated with the library shaders' own lobes.
#include "shader/shader.h"

// Last, since it gives GLSL's type names their meaning.
#include "shader/glsl.h"

namespace redmap {
namespace {
namespace text {
using namespace redmap::glsl;
#include "shader/library/include/widened.glsl"
}  // namespace text

glsl::Vec3 load(const Planes<3>& planes, std::size_t i) {
  return {lanes::load(planes[0] + i), lanes::load(planes[1] + i), lanes::load(planes[2] + i)};
}

glsl::Material load(const Materials& materials, std::size_t i) {
  return {load(materials.diffuse, i),        load(materials.specular, i),
          load(materials.transmittance, i),  lanes::load(materials.exponent[0] + i),
          lanes::load(materials.ggx[0] + i), lanes::load(materials.grazing[0] + i),
          load(materials.roughness, i)};
}

}  // namespace

void material_radiance_each(const Materials& materials, const DirectionPairs& pairs, Planes<3>& out) {
  const std::size_t size = materials.exponent.size();
  out.resize(size);
  for (std::size_t i = 0; i < size; i += kLanes) {
    const glsl::Vec3 value = text::widened_radiance(load(materials, i), load(materials.normals, i),
                                                    load(pairs.to_light, i), load(pairs.to_viewer, i));
    lanes::store(out[0] + i, value.x), lanes::store(out[1] + i, value.y), lanes::store(out[2] + i, value.z);
  }
}

}  // namespace redmap
