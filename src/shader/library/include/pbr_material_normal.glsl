// include/pbr_material.glsl for materials whose `normal` is not (0, 0, 1) everywhere.
#ifndef REDMAP_PBR_MATERIAL_NORMAL_GLSL
#define REDMAP_PBR_MATERIAL_NORMAL_GLSL
#include "include/pbr_material.glsl"

vec3 shading_normal(Surface at, Parameters p) {
  vec3 n = material_at(at, p).normal;
  return normalize(at.tangent * n.x + cross(at.normal, at.tangent) * n.y + at.normal * n.z);
}

#endif
