#include "export/glsl_text.h"

namespace redmap {

const std::string_view kGlslBefore = R"glsl(
// Define REDMAP_LIGHTS before including this for more than one light; for Vulkan, REDMAP_SET and the bindings too.
#ifndef REDMAP_LIGHTS
#define REDMAP_LIGHTS 1
#endif
#ifdef GL_ES
precision highp float;
precision highp int;
precision highp sampler2DArray;
precision highp usampler2D;
#endif
#if (defined(GL_ES) && __VERSION__ < 310) || (!defined(GL_ES) && __VERSION__ < 400)
int findLSB(uint bits) {
  for (int i = 0; i < 32; i++)
    if ((bits >> uint(i) & 1u) != 0u) return i;
  return -1;
}
int findMSB(uint bits) {
  for (int i = 31; i >= 0; i--)
    if ((bits >> uint(i) & 1u) != 0u) return i;
  return -1;
}
#endif
#ifdef VULKAN
#ifndef REDMAP_SET
#define REDMAP_SET 0
#define REDMAP_TEXELS_BINDING 0
#define REDMAP_WORDS_BINDING 1
#endif
layout(set = REDMAP_SET, binding = REDMAP_TEXELS_BINDING) uniform sampler2DArray redmap_texels;
layout(set = REDMAP_SET, binding = REDMAP_WORDS_BINDING) uniform usampler2D redmap_words;
#else
uniform sampler2DArray redmap_texels;  // weights.bin: RGBA8, linear, mip-mapped; u repeats if the manifest says so
uniform usampler2D redmap_words;       // words.bin: R32UI, 2048 words a row, nearest
#endif
uint redmap_word(uint i) { return texelFetch(redmap_words, ivec2(int(i & 2047u), int(i >> 11u)), 0).x; }

const vec4 redmap_eye = vec4(0.0);
const uint redmap_draws = 0u, redmap_far_stage = 2u, redmap_spread_stage = 3u;
uint redmap_stage = 2u;
uvec4 redmap_picture = uvec4(0u, 0u, 1u, 0u);  // z: lights
float redmap_random(uint i) { return 0.5; }
)glsl";

const std::string_view kGlslPatterns = R"glsl(
REDMAP_BOUND redmap_patterns[REDMAP_BASIS];
vec3 redmap_lights_to[REDMAP_LIGHTS];
vec3 redmap_lights_irradiance[REDMAP_LIGHTS];
vec3 redmap_arriving(uint l, RedmapHit hit, out vec3 to_light) {
  to_light = redmap_lights_to[l];
  return redmap_lights_irradiance[l];
}
)glsl";

const std::string_view kGlslAfter = R"glsl(
// What a fragment sees, all in object space: interpolated position and normal, the tangent of mesh.bin, uv of the map
// (v upwards), the unit vector to the viewer, and the flat number of the triangle that mesh.bin gives each vertex. Takes
// derivatives: call it where all fragments do.
RedmapHit redmap_seen(vec3 position, vec3 normal, vec3 tangent, vec2 uv, vec3 to_viewer, uint triangle) {
  RedmapHit hit;
  hit.position = position;
  hit.normal = normalize(normal);
  hit.to_viewer = to_viewer;
  hit.uv = uv;
  hit.triangle = triangle;
  hit.duv_dx = dFdx(uv);
  hit.duv_dy = dFdy(uv);
#if REDMAP_WRAPS
  hit.duv_dx.x -= floor(hit.duv_dx.x + 0.5);
  hit.duv_dy.x -= floor(hit.duv_dy.x + 0.5);
#endif
  // From changes across the picture to changes with uv.
  float determinant = hit.duv_dx.x * hit.duv_dy.y - hit.duv_dy.x * hit.duv_dx.y;
  float scale = determinant != 0.0 ? 1.0 / determinant : 0.0;
  vec3 px = dFdx(position), py = dFdy(position), nx = dFdx(hit.normal), ny = dFdy(hit.normal);
  hit.dp_du = (px * hit.duv_dy.y - py * hit.duv_dx.y) * scale;
  hit.dp_dv = (py * hit.duv_dx.x - px * hit.duv_dy.x) * scale;
  hit.dn_du = (nx * hit.duv_dy.y - ny * hit.duv_dx.y) * scale;
  hit.dn_dv = (ny * hit.duv_dx.x - nx * hit.duv_dy.x) * scale;
  hit.geometric = normalize(cross(px, py));
  if (dot(hit.geometric, to_viewer) < 0.0) hit.geometric = -hit.geometric;
  // At an outline derivatives say little about the side: normals that are hardly turned away decide.
  hit.turned = dot(hit.geometric, hit.normal) < 0.0 && dot(hit.normal, to_viewer) < -0.1;
  if (hit.turned) hit.normal = -hit.normal;
  hit.tangent = redmap_perpendicular(hit.normal, tangent);
  return hit;
}

// The same where it is known that `position` comes to lie at `pixel` of the picture, as gl_FragCoord counts. Devices put
// vertices on a grid before they interpolate, some on sixteenths of a pixel; what small triangles pass on is then that
// of a place beside, and their derivatives are off by more.
RedmapHit redmap_seen(vec3 position, vec3 normal, vec3 tangent, vec2 uv, vec3 to_viewer, uint triangle, vec2 pixel) {
  vec2 away = inverse(mat2(dFdx(pixel), dFdy(pixel))) * (gl_FragCoord.xy - pixel);
  if (!(dot(away, away) < 1.0)) away = vec2(0.0);  // a triangle seen from its edge
  return redmap_seen(position + dFdx(position) * away.x + dFdy(position) * away.y,
                     normal + dFdx(normal) * away.x + dFdy(normal) * away.y,
                     tangent + dFdx(tangent) * away.x + dFdy(tangent) * away.y,
                     uv + dFdx(uv) * away.x + dFdy(uv) * away.y, to_viewer, triangle);
}

// Radiance towards the viewer under the lights: unit vectors to them, object space, and their irradiance at normal
// incidence, shadows included. Close up it is the shader itself.
vec3 redmap_shade(RedmapHit hit, vec3 to_light[REDMAP_LIGHTS], vec3 irradiance[REDMAP_LIGHTS]) {
  redmap_lights_to = to_light;
  redmap_lights_irradiance = irradiance;
  redmap_picture.z = uint(REDMAP_LIGHTS);
  RedmapAxes axes = redmap_axes(hit.duv_dx, hit.duv_dy);
  float part = redmap_part(axes);
  vec3 sum = vec3(0.0);
  if (part < 1.0) sum = redmap_original(hit) * (1.0 - part);
  if (part <= 0.0) return sum;
  for (uint b = 0u; b < uint(REDMAP_BASIS); b++) redmap_patterns[b] = redmap_bound(redmap_basis_place(b));
  vec3 turn = redmap_curvature(hit);
  redmap_stage = turn.x + turn.z > redmap_map.w ? redmap_spread_stage : redmap_far_stage;
  return sum + redmap_filtered(hit, axes, 0u) * part;
}

// The shader itself, which aliases.
vec3 redmap_shade_original(RedmapHit hit, vec3 to_light[REDMAP_LIGHTS], vec3 irradiance[REDMAP_LIGHTS]) {
  redmap_lights_to = to_light;
  redmap_lights_irradiance = irradiance;
  redmap_picture.z = uint(REDMAP_LIGHTS);
  return redmap_original(hit);
}

// Under one light.
vec3 redmap_shade(RedmapHit hit, vec3 to_light, vec3 irradiance) {
  vec3 all_to[REDMAP_LIGHTS];
  vec3 all_irradiance[REDMAP_LIGHTS];
  for (int i = 0; i < REDMAP_LIGHTS; i++) {
    all_to[i] = to_light;
    all_irradiance[i] = i == 0 ? irradiance : vec3(0.0);
  }
  return redmap_shade(hit, all_to, all_irradiance);
}
)glsl";

}  // namespace redmap
