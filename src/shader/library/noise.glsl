// Thresholded noise: glossy blue islands in rough yellow paint.
#include "include/ggx.glsl"
#include "include/islands.glsl"
#include "include/phong.glsl"

struct Parameters {
  float scale;             // 14 [0.1, 1000] 1/unit: cells per object unit
  float threshold;         // 0 [-1, 1]: where the noise turns blue
  vec3 blue;               // 0.08 0.15 0.65 [0, 1]: diffuse colour of the islands
  vec3 yellow;             // 0.8 0.65 0.08 [0, 1]: diffuse colour of the paint between them
  float blue_exponent;     // 25 [1, 1000]: Phong exponent of the islands
  float yellow_roughness;  // 0.12 [0.02, 1]: GGX roughness of the paint
};

struct Pattern {
  vec3 diffuse;
  vec3 specular;
  float shape;  // Phong exponent of the islands, GGX roughness of the paint
  bool is_blue;
};

Pattern pattern(Surface at, Parameters p) {
  float value = island_height(at.position, p.scale);
  Pattern m;
  m.is_blue = value > p.threshold;
  m.diffuse = mix(p.yellow, p.blue, bvec3(m.is_blue));
  m.specular = vec3(mix(0.05, 0.25, m.is_blue));
  m.shape = mix(p.yellow_roughness, p.blue_exponent, m.is_blue);
  return m;
}

vec3 radiance(Pattern m, vec3 to_light, vec3 to_viewer) {
  vec3 phong = m.specular * phong_lobe(m.shape, to_light, to_viewer);
  vec3 ggx = ggx_lobe(m.specular, m.shape, to_light, to_viewer);
  vec3 reflectance = m.diffuse * (1.0 / pi) + mix(ggx, phong, bvec3(m.is_blue));
  return reflectance * visible_cosine(to_light, to_viewer);
}

Material material(Pattern m) {
  Material exported = ggx_material(m.diffuse, m.specular, m.shape);
  exported.exponent = m.shape;
  exported.ggx = mix(1.0, 0.0, m.is_blue);
  exported.grazing = exported.ggx;
  return exported;
}
