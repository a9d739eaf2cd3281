// Glazed tiles around a picture: a split shader whose two materials differ in gloss.
struct Parameters {
  vec2 tiles;       // 24 12 [1, 1000]: along u and v
  float joint;      // 0.08 [0, 0.5]: part of a tile that is joint
  float roughness;  // 0.1 [0.03, 1]: GGX roughness of the glaze
};

uniform sampler2D painting;  // colours of the glaze, once over all of uv

#include "include/ggx.glsl"
#include "include/phong.glsl"

struct Pattern {
  vec3 diffuse;
  bool is_glaze;
  float roughness;
};

Pattern pattern(Surface at, Parameters p) {
  vec2 cell = fract(at.uv * p.tiles), from_edge = min(cell, 1.0 - cell);
  bool is_glaze = min(from_edge.x, from_edge.y) > 0.5 * p.joint;
  // One colour a tile: the picture's at its centre.
  vec3 glaze = texture(painting, (floor(at.uv * p.tiles) + 0.5) / p.tiles).rgb;
  return Pattern(is_glaze ? glaze : vec3(0.45, 0.43, 0.40), is_glaze, p.roughness);
}

vec3 radiance(Pattern m, vec3 to_light, vec3 to_viewer) {
  vec3 reflectance = m.diffuse / pi;
  if (m.is_glaze) reflectance += ggx_lobe(vec3(0.04), m.roughness, to_light, to_viewer);
  return reflectance * visible_cosine(to_light, to_viewer);
}
