// The number of what is seen, and how near it is. Analytic surfaces are drawn as the box around them; what a pixel sees
// of them is where its ray hits. In layers (Everitt 2001): only what lies behind what was seen before.
layout(std430, binding = 0) readonly buffer Views { RedmapView views[]; };
layout(push_constant) uniform Draw { uint view; };
#ifdef REDMAP_NUMBERS
layout(location = 0) out uint number;
#endif

#ifdef REDMAP_LAYERS
layout(std430, binding = 2) readonly buffer Paths { vec4 paths[]; };  // as in paths.glsl
// Some roundings of a depth.
const float slack = 2e-6;

bool is_behind(float depth) {
  uvec2 at = uvec2(gl_FragCoord.xy);
  return depth < paths[at.y * uint(views[view].right.w) + at.x].w * (1.0 - slack);
}
#endif

#if REDMAP_SURFACE != 0
float depth_of(vec3 hit) { return redmap_depth(views[view], redmap_pixel(views[view], redmap_point_to_world(hit)).z); }

// How near the ray crosses the surface, and in layers where: 0 coming in, 1 going out. 0 if it does not.
float crossing(out uint place) {
  RedmapRay ray = redmap_view_ray(views[view], gl_FragCoord.xy);
  vec3 origin = redmap_point_to_object(ray.origin), direction = redmap_to_object(ray.direction), hit;
  place = 0u;
#ifdef REDMAP_LAYERS
  float along;
  if (redmap_crossing(origin, direction, false, hit, along) && is_behind(depth_of(hit))) return depth_of(hit);
  place = 1u;
  if (redmap_crossing(origin, direction, true, hit, along) && is_behind(depth_of(hit))) return depth_of(hit);
#else
  if (redmap_intersect(origin, direction, hit)) return depth_of(hit);
#endif
  return 0.0;
}
#endif

void main() {
  uint place = 0u;
#if REDMAP_SURFACE == 0
  place = uint(gl_PrimitiveID);
#ifdef REDMAP_LAYERS
  if (!is_behind(gl_FragCoord.z)) discard;
#endif
#else
  float depth = crossing(place);
  if (depth <= 0.0) discard;
  gl_FragDepth = depth;
#endif
#ifdef REDMAP_NUMBERS
  number = redmap_numbers.x + place;
#endif
}
