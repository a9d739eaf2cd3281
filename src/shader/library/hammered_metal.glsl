// Hammered metal: one GGX metal everywhere, and bumps of several sizes.
#include "include/bump.glsl"
#include "include/ggx.glsl"
#include "include/phong.glsl"

struct Parameters {
  float scale;      // 8 [0.1, 1000] 1/unit: largest bumps per object unit
  float slope;      // 0.25 [0, 2]: root mean square slope of the bumps
  float roughness;  // 0.1 [0.02, 1]: GGX roughness between the bumps
  vec3 metal;       // 0.8 0.55 0.35 [0, 1]: reflectance of the metal
};

struct Pattern {
  vec3 metal;
  float roughness;
};

Pattern pattern(Surface at, Parameters p) { return Pattern(p.metal, p.roughness); }

vec3 shading_normal(Surface at, Parameters p) {
  return bumped_normal(at.normal, p.slope * unit_bumps(at.position * p.scale, 4));
}

vec3 radiance(Pattern m, vec3 to_light, vec3 to_viewer) {
  return ggx_lobe(m.metal, m.roughness, to_light, to_viewer) * visible_cosine(to_light, to_viewer);
}

Material material(Pattern m) { return ggx_material(vec3(0.0), m.metal, m.roughness); }
