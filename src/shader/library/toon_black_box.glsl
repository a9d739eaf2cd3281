// Cartoon tiles as a black box: three bands of light and a hard highlight, in the colour of the hexagon.
#include "include/frame.glsl"
#include "include/hexagons.glsl"

struct Parameters {
  float around;  // 24 [3, 240]: columns of hexagons around the y axis
  float rows;    // 4 [0.1, 100] 1/unit: hexagons per object unit of height
  float line;    // 0.12 [0, 1]: width of the ink lines
  vec3 first;    // 0.85 0.25 0.15 [0, 1]: colour of every second hexagon of a row
  vec3 second;   // 0.95 0.8 0.35 [0, 1]: colour of the others
};

vec3 radiance(Surface at, Parameters p, vec3 to_light, vec3 to_viewer) {
  Hexagon tile = hexagon_around_y(at.position, p.around, p.rows);
  vec3 colour = mix(p.first, p.second, bvec3(mod(mod(tile.column, p.around), 2.0) > 0.5));
  bool is_ink = tile.edge < p.line;

  // Bands of light instead of the cosine, and a disk instead of a lobe.
  vec3 light = to_shading_frame(at, to_light);
  vec3 viewer = to_shading_frame(at, to_viewer);
  float band = 0.15 + 0.35 * step(0.25, light.z) + 0.5 * step(0.7, light.z);
  float mirror_cosine = 2.0 * light.z * viewer.z - dot(light, viewer);
  vec3 tile_radiance = colour * (band / pi) + vec3(0.5 * step(0.94, mirror_cosine));
  vec3 ink_radiance = vec3(0.02 / pi);
  return mix(vec3(0.0), mix(tile_radiance, ink_radiance, bvec3(is_ink)), bvec3(light.z > 0.0 && viewer.z > 0.0));
}
