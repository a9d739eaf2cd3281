// Satin with a broad blue and a narrow orange highlight: tint and gloss change together.
#include "include/islands.glsl"
#include "include/phong.glsl"

struct Parameters {
  float scale;            // 13 [0.1, 1000] 1/unit: islands per object unit
  float threshold;        // 0 [-1, 1]: height of the noise above which the islands stand out
  vec3 blue_diffuse;      // 0.02 0.02 0.02 [0, 1]: diffuse colour of the blue threads
  vec3 blue_specular;     // 0.1 0.2 0.8 [0, 1]: specular colour of the blue threads
  float blue_exponent;    // 6 [1, 1000]: Phong exponent of the blue threads
  vec3 orange_diffuse;    // 0.05 0.05 0.05 [0, 1]: diffuse colour of the orange threads
  vec3 orange_specular;   // 0.8 0.3 0.05 [0, 1]: specular colour of the orange threads
  float orange_exponent;  // 60 [1, 1000]: Phong exponent of the orange threads
};

struct Pattern {
  vec3 diffuse;
  vec3 specular;
  float exponent;
};

Pattern pattern(Surface at, Parameters p) {
  bool is_blue = island_height(at.position, p.scale) > p.threshold;
  Pattern m;
  m.diffuse = mix(p.orange_diffuse, p.blue_diffuse, bvec3(is_blue));
  m.specular = mix(p.orange_specular, p.blue_specular, bvec3(is_blue));
  m.exponent = mix(p.orange_exponent, p.blue_exponent, is_blue);
  return m;
}

vec3 radiance(Pattern m, vec3 to_light, vec3 to_viewer) {
  return phong_radiance(m.diffuse, m.specular, m.exponent, to_light, to_viewer);
}

Material material(Pattern m) { return phong_material(m.diffuse, m.specular, m.exponent); }
