// What a ray crosses of an object, in any order. Meshes have a tree of boxes behind their faces (gpu/triangle_tree.h): a
// node's left child is the next node, and each says which node follows where a ray misses it.
struct RedmapLightRay {
  vec3 origin, direction;  // object space, unit
  float reach, width;
};
vec3 redmap_let_through(uint triangle, RedmapLightRay ray);

#if REDMAP_SURFACE == 0
bool redmap_crosses(uint triangle, RedmapLightRay ray) {
  uint first = redmap_face_vectors * triangle;
  vec3 a = redmap_faces[first].xyz;
  vec3 e1 = redmap_faces[first + 2u].xyz - a, e2 = redmap_faces[first + 4u].xyz - a;
  vec3 p = cross(ray.direction, e2), from = ray.origin - a, q = cross(from, e1);
  float determinant = dot(e1, p);
  if (determinant == 0.0) return false;
  vec3 uvt = vec3(dot(from, p), dot(ray.direction, q), dot(e2, q)) / determinant;
  return uvt.x >= 0.0 && uvt.y >= 0.0 && uvt.x + uvt.y <= 1.0 && uvt.z > 0.0 && uvt.z < ray.reach;
}

vec3 redmap_passed_along(RedmapLightRay ray) {
  vec3 passed = vec3(1.0);
  // Boxes are wider than what is in them: so may the direction be tilted, and nothing is divided by nil.
  vec3 inverse = 1.0 / mix(ray.direction, vec3(1e-12), lessThan(abs(ray.direction), vec3(1e-12)));
  uint tree = redmap_face_vectors * redmap_numbers.y, count = 2u * redmap_numbers.y - 1u, node = 0u;
  while (node < count && passed != vec3(0.0)) {
    redmap_forget_rounds();
    vec4 lower = redmap_faces[tree + 2u * node], upper = redmap_faces[tree + 2u * node + 1u];
    vec3 a = (lower.xyz - ray.origin) * inverse, b = (upper.xyz - ray.origin) * inverse;
    vec3 near = min(a, b), far = max(a, b);
    bool meets = max(max(near.x, near.y), max(near.z, 0.0)) <= min(min(far.x, far.y), min(far.z, ray.reach));
    uint next = floatBitsToUint(lower.w), triangle = floatBitsToUint(upper.w);
    if (meets && triangle < redmap_numbers.y && redmap_crosses(triangle, ray))
      passed *= redmap_let_through(triangle, ray);
    node = meets ? node + 1u : next;
  }
  return passed;
}
#else
vec3 redmap_passed_along(RedmapLightRay ray) {
  vec3 passed = vec3(1.0), hit;
  for (uint goes_out = 0u; goes_out < 2u; goes_out++) {
    float along;
    if (redmap_crossing(ray.origin, ray.direction, goes_out == 1u, hit, along) && along < ray.reach)
      passed *= redmap_let_through(goes_out, ray);
  }
  return passed;
}
#endif
