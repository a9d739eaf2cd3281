// Cobbles of two kinds of stone and everything between, in pale mortar.
#include "include/phong.glsl"
#include "include/worley.glsl"

struct Parameters {
  float scale;     // 9 [0.1, 1000] 1/unit: stones per object unit
  float mortar;    // 0.09 [0, 1]: width of the joints
  vec3 joint;      // 0.55 0.53 0.5 [0, 1]: diffuse colour of the mortar
  vec3 red;        // 0.35 0.12 0.08 [0, 1]: diffuse colour of one kind of stone
  vec3 grey;       // 0.2 0.22 0.3 [0, 1]: diffuse colour of the other
  float exponent;  // 40 [1, 1000]: Phong exponent of the stones
};

struct Pattern {
  vec3 diffuse;
  vec3 specular;
  float exponent;
};

Pattern pattern(Surface at, Parameters p) {
  Cells cells = worley(at.position * p.scale);
  bool is_mortar = cells.second - cells.nearest < p.mortar;
  Pattern m;
  m.diffuse = mix(mix(p.red, p.grey, cells.id), p.joint, bvec3(is_mortar));
  m.specular = vec3(mix(mix(0.1, 0.25, cells.id), 0.0, is_mortar));
  m.exponent = mix(p.exponent, 1.0, is_mortar);
  return m;
}

vec3 radiance(Pattern m, vec3 to_light, vec3 to_viewer) {
  return phong_radiance(m.diffuse, m.specular, m.exponent, to_light, to_viewer);
}

Material material(Pattern m) { return phong_material(m.diffuse, m.specular, m.exponent); }
