// Glazed bricks around the y axis: flat and shiny, with slanting edges, in dull and rough mortar.
#include "include/blinn.glsl"
#include "include/bump.glsl"
#include "include/phong.glsl"

struct Parameters {
  float around;    // 24 [3, 240]: bricks around the y axis
  float rows;      // 6 [0.1, 100] 1/unit: courses per object unit of height
  float mortar;    // 0.012 [0, 1] unit: half the width of the mortar
  float edge;      // 0.012 [0.0001, 1] unit: width of the slanting edge
  float slope;     // 0.7 [0, 2]: slope of that edge
  float exponent;  // 200 [1, 1000]: Blinn exponent of the glaze
  vec3 glaze;      // 0.45 0.1 0.06 [0, 1]: diffuse colour of the bricks
  vec3 sand;       // 0.5 0.47 0.42 [0, 1]: diffuse colour of the mortar
};

struct Pattern {
  vec3 diffuse;
  float gloss;
  float exponent;
};

// Distances in object units from the middle of the mortar around the y axis and along it, negative where the brick lies
// on the lower side.
vec2 from_mortar(Surface at, Parameters p) {
  float row = at.position.y * p.rows;
  float column = atan(at.position.z, at.position.x) * (p.around / (2.0 * pi)) + 0.5 * mod(floor(row), 2.0);
  float x = fract(column);
  float y = fract(row);
  float width = distance_from_y(at.position) * (2.0 * pi) / p.around;
  return vec2(mix(x, x - 1.0, x > 0.5) * width, mix(y, y - 1.0, y > 0.5) / p.rows);
}

Pattern pattern(Surface at, Parameters p) {
  vec2 away = from_mortar(at, p);
  bool is_mortar = min(abs(away.x), abs(away.y)) < p.mortar;
  return Pattern(mix(p.glaze, p.sand, bvec3(is_mortar)), mix(0.5, 0.0, is_mortar), p.exponent);
}

vec3 shading_normal(Surface at, Parameters p) {
  vec2 away = from_mortar(at, p);
  float nearest = min(abs(away.x), abs(away.y));
  bool is_mortar = nearest < p.mortar;
  float rise = mix(0.0, p.slope, nearest >= p.mortar && nearest < p.mortar + p.edge);
  bool sideways = abs(away.x) < abs(away.y);
  vec3 across = mix(vec3(0.0, sign(away.y), 0.0), around_y(at.position) * sign(away.x), bvec3(sideways));
  vec3 grain = unit_bumps(at.position * 60.0, 3) * mix(0.03, 0.3, is_mortar);
  return bumped_normal(at.normal, across * rise + grain);
}

vec3 radiance(Pattern m, vec3 to_light, vec3 to_viewer) {
  vec3 reflectance = m.diffuse * (1.0 / pi) + vec3(m.gloss * blinn_lobe(m.exponent, to_light, to_viewer));
  return reflectance * visible_cosine(to_light, to_viewer);
}

// The Phong lobe of the same peak, and of the same width in the plane of incidence, where half vectors turn half as fast.
Material material(Pattern m) {
  float specular = m.gloss * (m.exponent + 2.0) / (m.exponent + 8.0);
  return phong_material(m.diffuse, vec3(specular), 0.25 * m.exponent);
}
