// Marble: dark veins through pale stone, colour and gloss changing continuously (Perlin 1985).
#include "include/noise.glsl"
#include "include/phong.glsl"

struct Parameters {
  float veins;       // 22 [0.1, 1000] 1/unit: phase of the veins along x, in radians per object unit
  float turbulence;  // 9 [0, 100]: how far turbulence bends the veins, in radians
  float scale;       // 5 [0.1, 1000] 1/unit: cells of turbulence per object unit
  vec3 dark;         // 0.1 0.08 0.07 [0, 1]: colour of the veins
  vec3 middle;       // 0.45 0.33 0.28 [0, 1]: colour halfway
  vec3 pale;         // 0.9 0.88 0.85 [0, 1]: colour of the stone
  float roughest;    // 10 [1, 1000]: Phong exponent in the veins
  float polish;      // 15 [1, 100]: times that, the exponent of the stone
};

struct Pattern {
  vec3 diffuse;
  vec3 specular;
  float exponent;
};

Pattern pattern(Surface at, Parameters p) {
  float phase = p.veins * at.position.x + p.turbulence * turbulence(at.position * p.scale, 5);
  float t = smoothstep(0.0, 1.0, 0.5 + 0.5 * sin(phase));
  Pattern m;
  m.diffuse = 0.8 * mix(mix(p.dark, p.middle, 2.0 * t), mix(p.middle, p.pale, 2.0 * t - 1.0), bvec3(t > 0.5));
  m.specular = vec3(0.01 + 0.2 * t * t);
  m.exponent = p.roughest * pow(p.polish, t);
  return m;
}

vec3 radiance(Pattern m, vec3 to_light, vec3 to_viewer) {
  return phong_radiance(m.diffuse, m.specular, m.exponent, to_light, to_viewer);
}

Material material(Pattern m) { return phong_material(m.diffuse, m.specular, m.exponent); }
