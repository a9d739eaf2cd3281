// What the scales around the y axis are made of: green ones, golden ones in every third place, and dull skin between.
#ifndef REDMAP_SCALE_PATTERN_GLSL
#define REDMAP_SCALE_PATTERN_GLSL
#include "include/hexagons.glsl"

struct Scale {
  vec3 diffuse;
  vec3 specular;
  float exponent;
};

// `around` columns in a turn; skin where a hexagon's edge is nearer than `gap`.
Scale scale_at(Hexagon hexagon, float around, float gap, vec3 skin, vec3 green, vec3 gold, float gold_exponent) {
  bool is_skin = hexagon.edge < gap;
  bool is_gold = mod(mod(hexagon.column, around) + 5.0 * hexagon.row + 1.0, 3.0) < 0.5;
  Scale m;
  m.diffuse = mix(mix(green, gold, bvec3(is_gold)), skin, bvec3(is_skin));
  m.specular = mix(mix(vec3(0.08), vec3(0.5, 0.42, 0.2), bvec3(is_gold)), vec3(0.02), bvec3(is_skin));
  m.exponent = mix(mix(15.0, gold_exponent, is_gold), 8.0, is_skin);
  return m;
}

#endif
