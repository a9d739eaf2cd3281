// Hexagonal scales around the y axis: green ones, golden ones with a very sharp highlight, and dull skin between.
#include "include/phong.glsl"
#include "include/scale_pattern.glsl"

struct Parameters {
  float around;         // 24 [3, 240]: columns of scales around the y axis (a whole multiple of 3 closes the pattern)
  float rows;           // 5 [0.1, 100] 1/unit: scales per object unit of height
  float gap;            // 0.14 [0, 1]: width of the skin between scales
  vec3 skin;            // 0.12 0.07 0.04 [0, 1]: diffuse colour of the skin
  vec3 green;           // 0.1 0.42 0.15 [0, 1]: diffuse colour of two scales in three
  vec3 gold;            // 0.35 0.25 0.05 [0, 1]: diffuse colour of the third
  float gold_exponent;  // 300 [1, 1000]: Phong exponent of the golden scales
};

struct Pattern {
  Scale scale;
};

Pattern pattern(Surface at, Parameters p) {
  Hexagon hexagon = hexagon_around_y(at.position, p.around, p.rows);
  return Pattern(scale_at(hexagon, p.around, p.gap, p.skin, p.green, p.gold, p.gold_exponent));
}

vec3 radiance(Pattern m, vec3 to_light, vec3 to_viewer) {
  return phong_radiance(m.scale.diffuse, m.scale.specular, m.scale.exponent, to_light, to_viewer);
}

Material material(Pattern m) { return phong_material(m.scale.diffuse, m.scale.specular, m.scale.exponent); }
