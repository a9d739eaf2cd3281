// A diffuse part, a dull and a glossy Phong lobe. Mixtures of such coatings are again such coatings, so that a shader
// which only mixes a few of them reduces to as many basis reflectances.
#ifndef REDMAP_TWO_LOBES_GLSL
#define REDMAP_TWO_LOBES_GLSL
#include "include/phong.glsl"

struct Coating {
  vec3 diffuse;
  vec3 dull;   // specular reflectance in the broad lobe
  vec3 gloss;  // and in the narrow one
};

const float kDullExponent = 7.0;
const float kGlossExponent = 140.0;

Coating mix_coating(Coating a, Coating b, float t) {
  return Coating(mix(a.diffuse, b.diffuse, t), mix(a.dull, b.dull, t), mix(a.gloss, b.gloss, t));
}

vec3 coating_radiance(Coating m, vec3 to_light, vec3 to_viewer) {
  vec3 reflectance = m.diffuse * (1.0 / pi) + m.dull * phong_lobe(kDullExponent, to_light, to_viewer) +
                     m.gloss * phong_lobe(kGlossExponent, to_light, to_viewer);
  return reflectance * visible_cosine(to_light, to_viewer);
}

// One Phong lobe with the summed reflectance and the mean variance, 2 / (exponent + 2), of the two.
Material coating_material(Coating m) {
  float dull = dot(m.dull, vec3(1.0));
  float gloss = dot(m.gloss, vec3(1.0));
  float variance =
      (dull * (2.0 / (kDullExponent + 2.0)) + gloss * (2.0 / (kGlossExponent + 2.0)) + 1e-6) / (dull + gloss + 1e-5);
  return phong_material(m.diffuse, m.dull + m.gloss, 2.0 / variance - 2.0);
}

#endif
