// Snow on wet rock: it lies where the bumpy ground is not too steep, so that normal and reflectance go together.
#include "include/bump.glsl"
#include "include/phong.glsl"

struct Parameters {
  float scale;     // 6 [0.1, 1000] 1/unit: largest bumps per object unit
  float slope;     // 0.4 [0, 2]: root mean square slope of the bumps
  float steepest;  // 0.5 [-1, 1]: cosine between the vertical and the normal of the steepest ground that holds snow
  float exponent;  // 60 [1, 1000]: Phong exponent of the wet rock
  vec3 rock;       // 0.12 0.11 0.1 [0, 1]: diffuse colour of the rock
};

struct Pattern {
  vec3 diffuse;
  vec3 specular;
  float exponent;
};

vec3 shading_normal(Surface at, Parameters p) {
  return bumped_normal(at.normal, p.slope * unit_bumps(at.position * p.scale, 4));
}

Pattern pattern(Surface at, Parameters p) {
  float snow = smoothstep(p.steepest - 0.05, p.steepest + 0.05, shading_normal(at, p).y);
  return Pattern(mix(p.rock, vec3(0.85, 0.87, 0.9), snow), mix(vec3(0.3), vec3(0.0), snow), p.exponent);
}

vec3 radiance(Pattern m, vec3 to_light, vec3 to_viewer) {
  return phong_radiance(m.diffuse, m.specular, m.exponent, to_light, to_viewer);
}

Material material(Pattern m) { return phong_material(m.diffuse, m.specular, m.exponent); }
