// Rust on metal, as a material: base colour, metallic and roughness, and an include that knows how materials reflect.
struct Parameters {
  float scale;  // 4 [0.1, 100] 1/unit: patches of rust per object unit
  float rust;   // 0.5 [0, 1]: how much of it
};

#include "include/noise.glsl"
#include "include/pbr_material.glsl"

PbrMaterial material_at(Surface at, Parameters p) {
  PbrMaterial m = default_material();
  float rusty = smoothstep(-0.05, 0.05, fbm(at.position * p.scale, 6) + p.rust - 0.5);
  m.base_color = mix(vec3(0.56, 0.57, 0.58), vec3(0.35, 0.12, 0.05), rusty);
  m.metallic = 1.0 - rusty;
  m.roughness = mix(0.3, 0.85, rusty);
  return m;
}
