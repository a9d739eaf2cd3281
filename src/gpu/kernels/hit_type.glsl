// A place that is seen, in object space.
struct RedmapHit {
  vec3 position, normal, geometric, tangent, dp_du, dp_dv, dn_du, dn_dv;
  vec2 uv;
  vec3 to_viewer;
  bool turned;  // the normals, towards the viewer
  vec2 duv_dx, duv_dy;
  uint triangle;
#ifdef REDMAP_POSED
  vec3 rest_position, rest_normal, rest_tangent;  // before any deformation, which is where shaders see it
#endif
};

// A unit vector perpendicular to `normal`, along `tangent` if that is possible.
vec3 redmap_perpendicular(vec3 normal, vec3 tangent) {
  vec3 x = tangent - normal * dot(tangent, normal);
  if (dot(x, x) < 1e-12 * max(1e-20, dot(tangent, tangent)))
    x = abs(normal.x) > 0.7 ? cross(vec3(0.0, 1.0, 0.0), normal) : cross(vec3(1.0, 0.0, 0.0), normal);
  return normalize(x);
}

// Directions at a deformed place, and the same before it was deformed.
#ifdef REDMAP_POSED
vec3 redmap_posed(RedmapHit hit, vec3 v) {
  return hit.tangent * dot(v, hit.rest_tangent) + hit.normal * dot(v, hit.rest_normal) +
         cross(hit.normal, hit.tangent) * dot(v, cross(hit.rest_normal, hit.rest_tangent));
}
vec3 redmap_at_rest(RedmapHit hit, vec3 v) {
  return hit.rest_tangent * dot(v, hit.tangent) + hit.rest_normal * dot(v, hit.normal) +
         cross(hit.rest_normal, hit.rest_tangent) * dot(v, cross(hit.normal, hit.tangent));
}
#else
vec3 redmap_posed(RedmapHit hit, vec3 v) { return v; }
vec3 redmap_at_rest(RedmapHit hit, vec3 v) { return v; }
#endif
