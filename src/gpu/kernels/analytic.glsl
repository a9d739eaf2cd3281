// First hits of rays with the sphere and the open cylinder, as src/surface/sphere.cpp and cylinder.cpp find them. From
// the ray's point closest to the centre or axis, which is small however far away the origin is, so that nothing cancels.
#if REDMAP_SURFACE == 1
bool redmap_intersect(vec3 origin, vec3 direction, out vec3 hit) {
  float closest = -dot(origin, direction);
  vec3 c = origin + closest * direction;
  float inside = redmap_shape.y * redmap_shape.y - dot(c, c);
  float half_chord = sqrt(max(inside, 0.0));
  float step = closest - half_chord > 0.0 ? -half_chord : half_chord;
  hit = c + step * direction;
  return inside >= 0.0 && closest + step > 0.0;
}
#elif REDMAP_SURFACE == 2
bool redmap_intersect(vec3 origin, vec3 direction, out vec3 hit) {
  float dd = max(dot(direction.xz, direction.xz), 1e-20);
  float closest = -dot(origin.xz, direction.xz) / dd;
  vec3 c = origin + closest * direction;
  float inside = redmap_shape.y * redmap_shape.y - dot(c.xz, c.xz);
  float half_chord = sqrt(max(inside, 0.0) / dd);
  float half_height = 0.5 * redmap_shape.z;
  vec3 first = c - half_chord * direction;
  bool sees_first = closest - half_chord > 0.0 && abs(first.y) <= half_height;
  hit = sees_first ? first : c + half_chord * direction;
  return inside >= 0.0 && (sees_first || (closest + half_chord > 0.0 && abs(hit.y) <= half_height));
}
#endif
