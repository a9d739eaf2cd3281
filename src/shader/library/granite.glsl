// Three independent continuous fields drive colour, highlight and gloss: no small basis can stand in for it.
#include "include/noise.glsl"
#include "include/phong.glsl"

struct Parameters {
  float scale;  // 9 [0.1, 1000] 1/unit: colour cells per object unit
};

struct Pattern {
  vec3 diffuse;
  vec3 specular;
  float exponent;
};

float field(vec3 p) { return clamp(0.5 + 1.2 * gradient_noise(p), 0.0, 1.0); }

Pattern pattern(Surface at, Parameters p) {
  vec3 q = at.position * p.scale;
  float colour = 3.0 * field(q);
  float highlight = field(q * (7.0 / 9.0) + vec3(17.2));
  float gloss = field(q * (11.0 / 9.0) + vec3(41.6));
  Pattern m;
  m.diffuse = mix(vec3(0.7, 0.1, 0.1), vec3(0.75, 0.7, 0.1), clamp(colour, 0.0, 1.0));
  m.diffuse = mix(m.diffuse, vec3(0.1, 0.5, 0.2), clamp(colour - 1.0, 0.0, 1.0));
  m.diffuse = mix(m.diffuse, vec3(0.1, 0.15, 0.6), clamp(colour - 2.0, 0.0, 1.0));
  m.specular = vec3(0.02 + 0.28 * highlight);
  m.exponent = 10.0 * pow(20.0, gloss);
  return m;
}

vec3 radiance(Pattern m, vec3 to_light, vec3 to_viewer) {
  return phong_radiance(m.diffuse, m.specular, m.exponent, to_light, to_viewer);
}

Material material(Pattern m) { return phong_material(m.diffuse, m.specular, m.exponent); }
