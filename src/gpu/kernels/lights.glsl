// How light arrives: point and directional lights, shadow maps (Williams 1978) with four comparisons a lookup (Reeves et
// al. 1987).
layout(std430, binding = 8) readonly buffer RedmapViews { RedmapView redmap_views[]; };  // of shadow maps first
layout(binding = 12) uniform sampler2DArray redmap_shadows;

// Places are moved off their surface by this many texels of the shadow map, since a comparison takes in the neighbours.
const float redmap_shadow_offset = 2.0;
// And may lie this part of their distance behind what the map has: roundings.
const float redmap_shadow_slack = 2e-4;

// The face of a cube of views that sees `offset`, in the order +x, -x, +y, -y, +z, -z.
int redmap_cube_face(vec3 offset) {
  vec3 a = abs(offset);
  if (a.x >= a.y && a.x >= a.z) return offset.x > 0.0 ? 0 : 1;
  if (a.y >= a.z) return offset.y > 0.0 ? 2 : 3;
  return offset.z > 0.0 ? 4 : 5;
}

// Part of the light that reaches a place, 0 to 1.
float redmap_lit(RedmapLight light, vec3 world, vec3 normal) {
  int layer = int(light.intensity.w);
  if (light.place.w > 1.5) layer += redmap_cube_face(world - light.place.xyz);
  RedmapView view = redmap_views[layer];
  float z = redmap_pixel(view, world).z;
  float texel = length(view.right.xyz) * (view.eye.w > 0.5 ? 1.0 : z);
  vec3 at = redmap_pixel(view, world + normal * (texel * redmap_shadow_offset));
  float depth = redmap_depth(view, at.z);
  depth += redmap_shadow_slack * (view.eye.w > 0.5 ? 1.0 : depth);
  vec2 corner = floor(at.xy - 0.5), part = at.xy - 0.5 - corner;
  ivec2 last = ivec2(view.right.w, view.down.w) - 1;
  float lit[4];
  for (int i = 0; i < 4; i++) {
    ivec2 texel_at = clamp(ivec2(corner) + ivec2(i & 1, i >> 1), ivec2(0), last);
    lit[i] = depth >= texelFetch(redmap_shadows, ivec3(texel_at, layer), 0).x ? 1.0 : 0.0;
  }
  return mix(mix(lit[0], lit[1], part.x), mix(lit[2], lit[3], part.x), part.y);
}

// Irradiance at normal incidence; `to_light` in object space.
vec3 redmap_arriving(uint l, RedmapHit hit, out vec3 to_light) {
  RedmapLight light = redmap_lights[l];
  vec3 world = redmap_point_to_world(hit.position);
  bool point = light.place.w > 0.5;
  vec3 path = point ? light.place.xyz - world : light.place.xyz;
  vec3 direction = normalize(path);
  to_light = redmap_to_object(direction);
  vec3 irradiance = light.intensity.xyz / (point ? dot(path, path) : 1.0);
#ifdef REDMAP_SHADOWS
  if (light.intensity.w >= 0.0) {
    // A face turned away from the light shadows itself.
    vec3 normal = redmap_to_world(hit.geometric);
    irradiance *= dot(normal, direction) > 0.0 ? redmap_lit(light, world, normal) : 0.0;
#ifdef REDMAP_LAYERS
    irradiance *= redmap_passed(l);
#endif
  }
#endif
  return irradiance;
}
