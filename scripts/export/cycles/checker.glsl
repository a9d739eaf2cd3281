// Copper cubes in a lattice of paint ones, in the terms of glTF: what Cycles' own checker node gives as well.
struct Parameters {
  float scale;  // 9 [0.1, 1000] 1/unit: cubes per object unit
};

#include "include/pbr_material.glsl"

PbrMaterial material_at(Surface at, Parameters p) {
  PbrMaterial m = default_material();
  vec3 cube = floor(at.position * p.scale + vec3(100.37, 100.21, 100.11));
  bool is_copper = mod(cube.x + cube.y + cube.z, 2.0) > 0.5;
  m.base_color = is_copper ? vec3(0.75, 0.38, 0.22) : vec3(0.05, 0.2, 0.4);
  m.metallic = is_copper ? 1.0 : 0.0;
  m.roughness = is_copper ? 0.35 : 0.6;
  return m;
}
