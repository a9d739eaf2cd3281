// Chrome islands on rubber: one averaged material cannot have both highlights.
#include "include/islands.glsl"
#include "include/phong.glsl"

struct Parameters {
  float scale;            // 13 [0.1, 1000] 1/unit: islands per object unit
  float threshold;        // 0 [-1, 1]: height of the noise above which the islands stand out
  vec3 chrome_diffuse;    // 0.02 0.02 0.02 [0, 1]: diffuse colour of the chrome
  vec3 chrome_specular;   // 0.6 0.6 0.6 [0, 1]: specular colour of the chrome
  float chrome_exponent;  // 300 [1, 1000]: Phong exponent of the chrome
  vec3 rubber_diffuse;    // 0.1 0.1 0.1 [0, 1]: diffuse colour of the rubber
  vec3 rubber_specular;   // 0.35 0.35 0.35 [0, 1]: specular colour of the rubber
  float rubber_exponent;  // 5 [1, 1000]: Phong exponent of the rubber
};

struct Pattern {
  vec3 diffuse;
  vec3 specular;
  float exponent;
};

Pattern pattern(Surface at, Parameters p) {
  bool is_chrome = island_height(at.position, p.scale) > p.threshold;
  Pattern m;
  m.diffuse = mix(p.rubber_diffuse, p.chrome_diffuse, bvec3(is_chrome));
  m.specular = mix(p.rubber_specular, p.chrome_specular, bvec3(is_chrome));
  m.exponent = mix(p.rubber_exponent, p.chrome_exponent, is_chrome);
  return m;
}

vec3 radiance(Pattern m, vec3 to_light, vec3 to_viewer) {
  return phong_radiance(m.diffuse, m.specular, m.exponent, to_light, to_viewer);
}

Material material(Pattern m) { return phong_material(m.diffuse, m.specular, m.exponent); }
