// Plain matte white: no computation at all, for measuring overhead.
#include "include/phong.glsl"

struct Parameters {
  float albedo;  // 1 [0, 1]: part of the light that is reflected
};

struct Pattern {
  float albedo;
};

Pattern pattern(Surface at, Parameters p) { return Pattern(p.albedo); }

vec3 radiance(Pattern m, vec3 to_light, vec3 to_viewer) {
  return vec3(m.albedo * (1.0 / pi) * visible_cosine(to_light, to_viewer));
}

Material material(Pattern m) { return phong_material(vec3(m.albedo), vec3(0.0), 1.0); }
