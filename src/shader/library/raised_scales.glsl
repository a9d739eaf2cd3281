// Hexagonal scales around the y axis that bulge over dull skin: green ones, and golden ones with a sharp highlight.
#include "include/bump.glsl"
#include "include/phong.glsl"
#include "include/scale_pattern.glsl"

struct Parameters {
  float around;         // 24 [3, 240]: columns of scales around the y axis (a whole multiple of 3 closes the pattern)
  float rows;           // 5 [0.1, 100] 1/unit: scales per object unit of height
  float gap;            // 0.14 [0, 1]: width of the skin between scales
  float rim;            // 0.5 [0.01, 1]: width of the bulging rim, as part of a scale
  float height;         // 0.02 [0, 1] unit: height of the scales over the skin
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

// Height over the skin at (x, y) of the tiling, 0 to 1: a quarter of an ellipse from the gap inwards.
float raised(float x, float y, Parameters p) {
  float inward = clamp((hexagon_at(x, y).edge - p.gap) / p.rim, 0.0, 1.0);
  return sqrt(inward * (2.0 - inward) + 0.01);
}

vec3 shading_normal(Surface at, Parameters p) {
  // Central differences a hundredth of a scale wide, turned into object units.
  const float h = 0.005;
  float x = atan(at.position.z, at.position.x) * (p.around / (2.0 * pi));
  float y = at.position.y * p.rows;
  float dx = (raised(x + h, y, p) - raised(x - h, y, p)) * (0.5 / h);
  float dy = (raised(x, y + h, p) - raised(x, y - h, p)) * (0.5 / h);
  float columns_per_unit = p.around / (2.0 * pi * distance_from_y(at.position));
  vec3 gradient = around_y(at.position) * (dx * columns_per_unit) + vec3(0.0, dy * p.rows, 0.0);
  return bumped_normal(at.normal, gradient * p.height);
}

vec3 radiance(Pattern m, vec3 to_light, vec3 to_viewer) {
  return phong_radiance(m.scale.diffuse, m.scale.specular, m.scale.exponent, to_light, to_viewer);
}

Material material(Pattern m) { return phong_material(m.scale.diffuse, m.scale.specular, m.scale.exponent); }
