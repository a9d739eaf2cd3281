// The shaders around redmap.glsl: from three.js' attributes, lights and matrices to what its functions take, which is all in
// object space.
import type { RedmapManifest, RedmapParameter } from './manifest.js';

export const kVertexText = `
in vec3 redmap_tangent;
in float redmap_triangle;
out vec3 redmap_three_position, redmap_three_normal, redmap_three_tangent;
out vec2 redmap_three_uv;
flat out uint redmap_three_triangle;
void main() {
  redmap_three_position = position;
  redmap_three_normal = normal;
  redmap_three_tangent = redmap_tangent;
  redmap_three_uv = uv;
  redmap_three_triangle = uint(redmap_triangle);
  gl_Position = projectionMatrix * (modelViewMatrix * vec4(position, 1.0));
}`;

// Names of three.js' own that a shader may well have, too.
const kBefore = `
#undef saturate
#define luminance redmap_own_luminance
#if NUM_DIR_LIGHTS + NUM_POINT_LIGHTS > 0
#define REDMAP_LIGHTS (NUM_DIR_LIGHTS + NUM_POINT_LIGHTS)
#endif
`;

const kAfter = `
#undef luminance
in vec3 redmap_three_position, redmap_three_normal, redmap_three_tangent;
in vec2 redmap_three_uv;
flat in uint redmap_three_triangle;
uniform mat4 modelViewMatrix, projectionMatrix;
uniform vec4 redmap_viewport;
uniform int redmap_method;
#if NUM_DIR_LIGHTS > 0
struct RedmapDirectionalLight { vec3 direction, color; };
uniform RedmapDirectionalLight directionalLights[NUM_DIR_LIGHTS];
#endif
#if NUM_POINT_LIGHTS > 0
struct RedmapPointLight { vec3 position, color; float distance, decay; };
uniform RedmapPointLight pointLights[NUM_POINT_LIGHTS];
// As getDistanceAttenuation() of three.js.
float redmap_fallen_off(float away, RedmapPointLight light) {
  float part = 1.0 / max(pow(away, light.decay), 1e-6);
  if (light.distance <= 0.0) return part;
  float end = clamp(1.0 - pow(away / light.distance, 4.0), 0.0, 1.0);
  return part * end * end;
}
#endif
// Lights are given in the camera's space. Objects may be turned, moved and scaled evenly.
void redmap_three_lights(out vec3 to_light[REDMAP_LIGHTS], out vec3 irradiance[REDMAP_LIGHTS]) {
  mat3 to_object = transpose(mat3(modelViewMatrix));
  to_light[0] = vec3(0.0, 0.0, 1.0);
  irradiance[0] = vec3(0.0);
#if NUM_DIR_LIGHTS > 0
  for (int i = 0; i < NUM_DIR_LIGHTS; i++) {
    to_light[i] = normalize(to_object * directionalLights[i].direction);
    irradiance[i] = directionalLights[i].color;
  }
#endif
#if NUM_POINT_LIGHTS > 0
  vec3 here = (modelViewMatrix * vec4(redmap_three_position, 1.0)).xyz;
  for (int i = 0; i < NUM_POINT_LIGHTS; i++) {
    vec3 away = pointLights[i].position - here;
    to_light[NUM_DIR_LIGHTS + i] = normalize(to_object * away);
    irradiance[NUM_DIR_LIGHTS + i] = pointLights[i].color * redmap_fallen_off(length(away), pointLights[i]);
  }
#endif
}
vec3 redmap_three_to_viewer() {
  mat3 to_object = transpose(mat3(modelViewMatrix));
  if (isOrthographic) return normalize(to_object[2]);
  float scale = dot(modelViewMatrix[0].xyz, modelViewMatrix[0].xyz);
  return normalize(-(to_object * modelViewMatrix[3].xyz) / scale - redmap_three_position);
}
`;

const kMain = `
  vec4 clip = projectionMatrix * (modelViewMatrix * vec4(redmap_three_position, 1.0));
  vec2 pixel = redmap_viewport.xy + (clip.xy / clip.w * 0.5 + 0.5) * redmap_viewport.zw;
  RedmapHit hit = redmap_seen(redmap_three_position, redmap_three_normal, redmap_three_tangent, redmap_three_uv,
                              redmap_three_to_viewer(), redmap_three_triangle, pixel);
  vec3 to_light[REDMAP_LIGHTS], irradiance[REDMAP_LIGHTS];
  redmap_three_lights(to_light, irradiance);
  vec3 radiance_ = redmap_method == 0 ? redmap_shade(hit, to_light, irradiance)
                                      : redmap_shade_original(hit, to_light, irradiance);
  gl_FragColor = vec4(radiance_, 1.0);
#include <tonemapping_fragment>
#include <colorspace_fragment>
}
`;

/** The uniform that a parameter is. */
export function uniformOf(parameter: RedmapParameter): string {
  return `redmap_parameter_${parameter.name}`;
}

/** The fragment shader around `text`, redmap.glsl. */
export function fragmentText(manifest: RedmapManifest, text: string): string {
  const uniforms = manifest.parameters.map(p => `uniform ${p.type} ${uniformOf(p)};\n`);
  const values = manifest.parameters.map(p => `  redmap_parameters.${p.name} = ${uniformOf(p)};\n`);
  return `${kBefore}${text}${kAfter}${uniforms.join('')}void main() {\n${values.join('')}${kMain}`;
}
