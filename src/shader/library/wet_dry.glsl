// Wet patches on dry ground: dark with a sharp highlight beside pale and dull.
#include "include/islands.glsl"
#include "include/phong.glsl"

struct Parameters {
  float scale;         // 13 [0.1, 1000] 1/unit: islands per object unit
  float threshold;     // 0 [-1, 1]: height of the noise above which the islands stand out
  vec3 wet_diffuse;    // 0.1 0.08 0.06 [0, 1]: diffuse colour of the wet ground
  vec3 wet_specular;   // 0.25 0.25 0.25 [0, 1]: specular colour of the wet ground
  float wet_exponent;  // 400 [1, 1000]: Phong exponent of the wet ground
  vec3 dry_diffuse;    // 0.4 0.33 0.25 [0, 1]: diffuse colour of the dry ground
  vec3 dry_specular;   // 0.08 0.08 0.08 [0, 1]: specular colour of the dry ground
  float dry_exponent;  // 4 [1, 1000]: Phong exponent of the dry ground
};

struct Pattern {
  vec3 diffuse;
  vec3 specular;
  float exponent;
};

Pattern pattern(Surface at, Parameters p) {
  bool is_wet = island_height(at.position, p.scale) > p.threshold;
  Pattern m;
  m.diffuse = mix(p.dry_diffuse, p.wet_diffuse, bvec3(is_wet));
  m.specular = mix(p.dry_specular, p.wet_specular, bvec3(is_wet));
  m.exponent = mix(p.dry_exponent, p.wet_exponent, is_wet);
  return m;
}

vec3 radiance(Pattern m, vec3 to_light, vec3 to_viewer) {
  return phong_radiance(m.diffuse, m.specular, m.exponent, to_light, to_viewer);
}

Material material(Pattern m) { return phong_material(m.diffuse, m.specular, m.exponent); }
