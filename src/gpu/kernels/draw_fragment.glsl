// The number of what is seen, and how near it is. Analytic surfaces are drawn as the box around them; what a pixel sees
// of them is where its ray hits.
layout(std430, binding = 0) readonly buffer Views { RedmapView views[]; };
layout(push_constant) uniform Draw { uint view; };
#ifdef REDMAP_NUMBERS
layout(location = 0) out uint number;
#endif

void main() {
#if REDMAP_SURFACE == 0
  uint triangle = uint(gl_PrimitiveID);
#else
  uint triangle = 0u;
  RedmapRay ray = redmap_view_ray(views[view], gl_FragCoord.xy);
  vec3 hit;
  if (!redmap_intersect(redmap_point_to_object(ray.origin), redmap_to_object(ray.direction), hit)) discard;
  gl_FragDepth = redmap_depth(views[view], redmap_pixel(views[view], redmap_point_to_world(hit)).z);
#endif
#ifdef REDMAP_NUMBERS
  number = redmap_numbers.x + triangle;
#endif
}
