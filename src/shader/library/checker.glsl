// 3D checkerboard of matt and polished cubes: two colours, two specular exponents.
#include "include/phong.glsl"

struct Parameters {
  float scale;           // 9 [0.1, 1000] 1/unit: cubes per object unit
  vec3 dark;             // 0.05 0.05 0.06 [0, 1]: diffuse colour of the polished cubes
  vec3 light;            // 0.8 0.78 0.72 [0, 1]: diffuse colour of the matt cubes
  float dark_exponent;   // 120 [1, 1000]: Phong exponent of the polished cubes
  float light_exponent;  // 10 [1, 1000]: Phong exponent of the matt cubes
};

struct Pattern {
  vec3 diffuse;
  vec3 specular;
  float exponent;
};

Pattern pattern(Surface at, Parameters p) {
  // The offsets keep the planes between cubes away from the planes of symmetry of objects around the origin.
  vec3 cube = floor(at.position * p.scale + vec3(0.37, 0.21, 0.11));
  bool is_dark = mod(cube.x + cube.y + cube.z, 2.0) > 0.5;
  Pattern m;
  m.diffuse = mix(p.light, p.dark, bvec3(is_dark));
  m.specular = vec3(mix(0.08, 0.35, is_dark));
  m.exponent = mix(p.light_exponent, p.dark_exponent, is_dark);
  return m;
}

vec3 radiance(Pattern m, vec3 to_light, vec3 to_viewer) {
  return phong_radiance(m.diffuse, m.specular, m.exponent, to_light, to_viewer);
}

Material material(Pattern m) { return phong_material(m.diffuse, m.specular, m.exponent); }
