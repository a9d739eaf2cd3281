// Two lacquers as a black box, each with a broad and a narrow lobe of its own tint, selected by noise.
#include "include/frame.glsl"
#include "include/islands.glsl"
#include "include/phong.glsl"

struct Parameters {
  float scale;  // 10 [0.1, 1000] 1/unit: islands per object unit
  vec3 red;     // 0.35 0.03 0.02 [0, 1]: diffuse colour of the islands
  vec3 black;   // 0.02 0.02 0.025 [0, 1]: diffuse colour of the lacquer between them
  vec3 dust;    // 0.3 0.22 0.1 [0, 1]: tint of the broad lobe of the islands
};

vec3 radiance(Surface at, Parameters p, vec3 to_light, vec3 to_viewer) {
  bool is_red = island_height(at.position, p.scale) > 0.0;
  vec3 light = to_shading_frame(at, to_light);
  vec3 viewer = to_shading_frame(at, to_viewer);
  vec3 diffuse = mix(p.black, p.red, bvec3(is_red));
  vec3 broad = mix(vec3(0.05), p.dust, bvec3(is_red)) * phong_lobe(mix(20.0, 6.0, is_red), light, viewer);
  float narrow = mix(0.25, 0.12, is_red) * phong_lobe(mix(350.0, 90.0, is_red), light, viewer);
  return (diffuse * (1.0 / pi) + broad + vec3(narrow)) * visible_cosine(light, viewer);
}
