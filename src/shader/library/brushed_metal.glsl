// Brushed metal: swirls of fine grain, each brushed in a direction of its own; GGX or Ward, both anisotropic.
#include "include/ggx.glsl"
#include "include/noise.glsl"
#include "include/phong.glsl"
#include "include/ward.glsl"

struct Parameters {
  float scale;          // 6 [0.1, 1000] 1/unit: swirls per object unit
  float turn;           // 3 [0, 20] rad: how far the grain turns between them
  vec2 roughness;       // 0.05 0.3 [0.02, 1]: along the grain and across it
  vec3 metal;           // 0.75 0.76 0.8 [0, 1]: reflectance of the metal
  float ward;           // 0 [0, 1]: 0 GGX, 1 Ward
};

struct Pattern {
  vec3 metal;
  vec2 roughness;
  float ward;
};

// Along the grain.
vec3 shading_tangent(Surface at, Parameters p) {
  float angle = p.turn * gradient_noise(at.position * p.scale);
  return at.tangent * cos(angle) + cross(at.normal, at.tangent) * sin(angle);
}

Pattern pattern(Surface at, Parameters p) { return Pattern(p.metal, p.roughness, p.ward); }

vec3 radiance(Pattern m, vec3 to_light, vec3 to_viewer) {
  vec3 ggx = ggx_anisotropic_lobe(m.metal, m.roughness, to_light, to_viewer);
  return mix(ggx, ward_lobe(m.metal, m.roughness, to_light, to_viewer), m.ward) * visible_cosine(to_light, to_viewer);
}

Material material(Pattern m) {
  Material exported = ggx_material(vec3(0.0), m.metal, 1.0);
  exported.roughness = vec3(m.roughness.x * m.roughness.x, 0.0, m.roughness.y * m.roughness.y);
  return exported;
}
