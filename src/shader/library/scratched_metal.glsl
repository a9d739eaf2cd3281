// Scratched metal: brushed around the y axis, anisotropic, with fine grooves and a few deep ones.
#include "include/bump.glsl"
#include "include/ggx.glsl"
#include "include/phong.glsl"

struct Parameters {
  float grooves;        // 60 [1, 2000] 1/unit: fine grooves per object unit
  float slope;          // 0.08 [0, 1]: root mean square slope of the fine grooves
  float deep;           // 0.5 [0, 2]: slope of the deep ones
  vec2 roughness;       // 0.08 0.25 [0.02, 1]: GGX roughness along the grooves and across them
  vec3 metal;           // 0.75 0.76 0.8 [0, 1]: reflectance of the metal
};

struct Pattern {
  vec3 metal;
  vec2 roughness;
};

// Both kinds of grooves run around the y axis: long features there, short ones along it.
vec3 shading_normal(Surface at, Parameters p) {
  vec3 stretch = vec3(2.0, p.grooves, 2.0);
  float fine = noise_gradient(at.position * stretch).y * (p.slope / kNoiseSlope);
  vec3 sparse = at.position * vec3(1.3, 0.2 * p.grooves, 1.3) + vec3(17.3);
  float is_deep = smoothstep(0.35, 0.5, gradient_noise(sparse));
  float deep = is_deep * p.deep * clamp(2.0 * noise_gradient(sparse).y, -1.0, 1.0);
  return bumped_normal(at.normal, vec3(0.0, fine + deep, 0.0));
}

vec3 shading_tangent(Surface at, Parameters p) { return around_y(at.position); }

Pattern pattern(Surface at, Parameters p) { return Pattern(p.metal, p.roughness); }

vec3 radiance(Pattern m, vec3 to_light, vec3 to_viewer) {
  return ggx_anisotropic_lobe(m.metal, m.roughness, to_light, to_viewer) * visible_cosine(to_light, to_viewer);
}

Material material(Pattern m) {
  Material exported = ggx_material(vec3(0.0), m.metal, 1.0);
  exported.roughness = vec3(m.roughness.x * m.roughness.x, 0.0, m.roughness.y * m.roughness.y);
  return exported;
}
