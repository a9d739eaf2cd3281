// Where rays cross the sphere and the open cylinder, as src/surface/sphere.cpp and cylinder.cpp find it. From the ray's
// point closest to the centre or axis, which is small however far away the origin is, so that nothing cancels.
#if REDMAP_SURFACE != 0
// Where a ray comes in, or goes out: `along` the ray, by its unit `direction`. False if it does not.
bool redmap_crossing(vec3 origin, vec3 direction, bool goes_out, out vec3 hit, out float along) {
#if REDMAP_SURFACE == 1
  float closest = -dot(origin, direction);
  vec3 c = origin + closest * direction;
  float inside = redmap_shape.y * redmap_shape.y - dot(c, c);
  float half_chord = sqrt(max(inside, 0.0));
#else
  float dd = max(dot(direction.xz, direction.xz), 1e-20);
  float closest = -dot(origin.xz, direction.xz) / dd;
  vec3 c = origin + closest * direction;
  float inside = redmap_shape.y * redmap_shape.y - dot(c.xz, c.xz);
  float half_chord = sqrt(max(inside, 0.0) / dd);
#endif
  float step = goes_out ? half_chord : -half_chord;
  hit = c + step * direction;
  along = closest + step;
#if REDMAP_SURFACE == 2
  if (abs(hit.y) > 0.5 * redmap_shape.z) return false;
#endif
  return inside >= 0.0 && along > 0.0;
}

// The first of them.
bool redmap_intersect(vec3 origin, vec3 direction, out vec3 hit) {
  float along;
  vec3 first;
  bool comes_in = redmap_crossing(origin, direction, false, first, along);
  bool goes_out = redmap_crossing(origin, direction, true, hit, along);
  if (comes_in) hit = first;
  return comes_in || goes_out;
}
#endif
