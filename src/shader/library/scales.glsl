// Hexagonal scales around the y axis: green ones, golden ones with a very sharp highlight, and dull skin between.
#include "include/hexagons.glsl"
#include "include/phong.glsl"

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
  vec3 diffuse;
  vec3 specular;
  float exponent;
};

Pattern pattern(Surface at, Parameters p) {
  Hexagon scale = hexagon_around_y(at.position, p.around, p.rows);
  bool is_skin = scale.edge < p.gap;
  bool is_gold = mod(mod(scale.column, p.around) + 5.0 * scale.row + 1.0, 3.0) < 0.5;
  Pattern m;
  m.diffuse = mix(mix(p.green, p.gold, bvec3(is_gold)), p.skin, bvec3(is_skin));
  m.specular = mix(mix(vec3(0.08), vec3(0.5, 0.42, 0.2), bvec3(is_gold)), vec3(0.02), bvec3(is_skin));
  m.exponent = mix(mix(15.0, p.gold_exponent, is_gold), 8.0, is_skin);
  return m;
}

vec3 radiance(Pattern m, vec3 to_light, vec3 to_viewer) {
  return phong_radiance(m.diffuse, m.specular, m.exponent, to_light, to_viewer);
}

Material material(Pattern m) { return phong_material(m.diffuse, m.specular, m.exponent); }
