// What a sample hits, as the surfaces' complete() and render/hit_footprint.h say it, in object space.
layout(binding = 10) uniform usampler2DArray redmap_seen;  // numbers of triangles

#if REDMAP_SURFACE == 0
// Two vec4 a vertex: position, normal, uv. Deformed meshes have as many again, at rest.
#ifdef REDMAP_POSED
const uint redmap_face_vectors = 12u;
#else
const uint redmap_face_vectors = 6u;
#endif
layout(std430, binding = 2) readonly buffer RedmapFaces { vec4 redmap_faces[]; };

#ifdef REDMAP_POSED
// `first`: of the face at rest; `weights`: of its vertices 1 and 2.
void redmap_complete_rest(uint first, vec2 weights, inout RedmapHit hit) {
  vec4 a0 = redmap_faces[first], a1 = redmap_faces[first + 1u];
  vec4 b0 = redmap_faces[first + 2u], b1 = redmap_faces[first + 3u];
  vec4 c0 = redmap_faces[first + 4u], c1 = redmap_faces[first + 5u];
  vec3 e1 = b0.xyz - a0.xyz, e2 = c0.xyz - a0.xyz;
  hit.rest_position = a0.xyz + e1 * weights.x + e2 * weights.y;
  vec3 normal = vec3(a0.w, a1.xy) * (1.0 - weights.x - weights.y) + vec3(b0.w, b1.xy) * weights.x +
                vec3(c0.w, c1.xy) * weights.y;
  hit.rest_normal = normalize(dot(normal, normal) > 0.0 ? normal : cross(e1, e2));
  vec2 t1 = b1.zw - a1.zw, t2 = c1.zw - a1.zw;
  float determinant = t1.x * t2.y - t1.y * t2.x;
  vec3 along_u = determinant != 0.0 ? (e1 * t2.y - e2 * t1.y) / determinant : e1;
  hit.rest_tangent = redmap_perpendicular(hit.rest_normal, along_u);
}
#endif

void redmap_complete(uint triangle, vec3 origin, vec3 direction, inout RedmapHit hit) {
  uint first = redmap_face_vectors * triangle;
  vec4 a0 = redmap_faces[first], a1 = redmap_faces[first + 1u];
  vec4 b0 = redmap_faces[first + 2u], b1 = redmap_faces[first + 3u];
  vec4 c0 = redmap_faces[first + 4u], c1 = redmap_faces[first + 5u];
  vec3 e1 = b0.xyz - a0.xyz, e2 = c0.xyz - a0.xyz;
  vec3 p = cross(direction, e2), from = origin - a0.xyz;
  float inverse = 1.0 / dot(e1, p);
  float u = clamp(dot(from, p) * inverse, 0.0, 1.0);
  float v = clamp(dot(direction, cross(from, e1)) * inverse, 0.0, 1.0 - u);

  hit.position = a0.xyz + e1 * u + e2 * v;
  hit.geometric = normalize(cross(e1, e2));
  vec3 na = vec3(a0.w, a1.xy), n1 = vec3(b0.w, b1.xy) - na, n2 = vec3(c0.w, c1.xy) - na;
  vec3 blended = na + n1 * u + n2 * v;
  float blended_length = length(blended);
  hit.normal = blended_length > 0.0 ? blended / blended_length : hit.geometric;
  float unblend = blended_length > 0.0 ? 1.0 / blended_length : 0.0;

  vec2 t1 = b1.zw - a1.zw, t2 = c1.zw - a1.zw;
  hit.uv = a1.zw + t1 * u + t2 * v;
  float determinant = t1.x * t2.y - t1.y * t2.x;
  bool has_shape = determinant != 0.0;
  float scale = has_shape ? 1.0 / determinant : 0.0;
  hit.dp_du = (e1 * t2.y - e2 * t1.y) * scale;
  hit.dp_dv = (e2 * t1.x - e1 * t2.x) * scale;
  hit.dn_du = (n1 * t2.y - n2 * t1.y) * scale;
  hit.dn_dv = (n2 * t1.x - n1 * t2.x) * scale;
  if (!has_shape) {
    hit.dp_du = redmap_perpendicular(hit.geometric, e1) * redmap_shape.w;
    hit.dp_dv = cross(hit.geometric, hit.dp_du);
  }
  hit.dn_du = (hit.dn_du - hit.normal * dot(hit.normal, hit.dn_du)) * unblend;
  hit.dn_dv = (hit.dn_dv - hit.normal * dot(hit.normal, hit.dn_dv)) * unblend;
  hit.tangent = redmap_perpendicular(hit.normal, hit.dp_du);
#ifdef REDMAP_POSED
  redmap_complete_rest(first + 6u, vec2(u, v), hit);
#endif
}
#else
const float redmap_pi = 3.14159265;

void redmap_complete(uint triangle, vec3 origin, vec3 direction, inout RedmapHit hit) {
  vec3 place;
#ifdef REDMAP_LAYERS
  // Number 0 is where rays come in, 1 where they go out.
  float along;
  redmap_crossing(origin, direction, triangle == 1u, place, along);
#else
  redmap_intersect(origin, direction, place);
#endif
  float across = length(place.xz), turns = atan(place.z, place.x) / (2.0 * redmap_pi);
  vec2 axis = across > 0.0 ? place.xz / across : vec2(1.0, 0.0);
  hit.uv.x = turns < 0.0 ? turns + 1.0 : turns;
  hit.tangent = vec3(-axis.y, 0.0, axis.x);
#if REDMAP_SURFACE == 1
  hit.uv.y = atan(across, place.y) / redmap_pi;
  hit.normal = normalize(place);
  hit.position = hit.normal * redmap_shape.y;
  hit.dn_dv = vec3(hit.normal.y * axis.x, -length(hit.normal.xz), hit.normal.y * axis.y) * redmap_pi;
  hit.dp_dv = hit.dn_dv * redmap_shape.y;
  hit.dn_du = hit.tangent * (2.0 * redmap_pi * length(hit.normal.xz));
#else
  hit.uv.y = place.y / redmap_shape.z + 0.5;
  hit.normal = vec3(axis.x, 0.0, axis.y);
  hit.position = vec3(axis.x * redmap_shape.y, place.y, axis.y * redmap_shape.y);
  hit.dn_dv = vec3(0.0);
  hit.dp_dv = vec3(0.0, redmap_shape.z, 0.0);
  hit.dn_du = hit.tangent * (2.0 * redmap_pi);
#endif
  hit.dp_du = hit.dn_du * redmap_shape.y;
  hit.geometric = hit.normal;
}
#endif

// Change of uv under a change of position in the tangent plane: least squares on dp_du, dp_dv.
vec2 redmap_uv_change(RedmapHit hit, vec3 dp) {
  float uu = dot(hit.dp_du, hit.dp_du), uv = dot(hit.dp_du, hit.dp_dv), vv = dot(hit.dp_dv, hit.dp_dv);
  float determinant = max(uu * vv - uv * uv, 1e-30);
  float pu = dot(dp, hit.dp_du), pv = dot(dp, hit.dp_dv);
  return vec2(vv * pu - uv * pv, uu * pv - uv * pu) / determinant;
}

void redmap_find_footprint(vec3 unnormalised, vec3 eye, inout RedmapHit hit) {
  float extent = 1.0 / float(redmap_picture.y);
  float dd = dot(unnormalised, unnormalised), scale = inversesqrt(dd) / dd;
  vec3 right = redmap_right.xyz, down = redmap_down.xyz;
  vec3 dx = redmap_to_object((right * dd - unnormalised * dot(unnormalised, right)) * scale);
  vec3 dy = redmap_to_object((down * dd - unnormalised * dot(unnormalised, down)) * scale);
  float facing = -dot(hit.to_viewer, hit.geometric);
  float cosine = abs(facing) > redmap_least_cosine ? facing : (facing < 0.0 ? -redmap_least_cosine : redmap_least_cosine);
  float width = distance(hit.position, eye) * extent;
  dx *= width;
  dy *= width;
  hit.duv_dx = redmap_uv_change(hit, dx + hit.to_viewer * (dot(dx, hit.geometric) / cosine));
  hit.duv_dy = redmap_uv_change(hit, dy + hit.to_viewer * (dot(dy, hit.geometric) / cosine));
}

// `number`: of the object's triangles. `place`: of the sample in the band.
RedmapHit redmap_hit(uint number, uvec2 place) {
  vec2 pixel = (vec2(place) + vec2(0.5, 0.5 + float(redmap_first_row))) / float(redmap_picture.y);
  vec3 unnormalised = redmap_top_left.xyz + redmap_right.xyz * pixel.x + redmap_down.xyz * pixel.y;
  vec3 eye = redmap_point_to_object(redmap_eye.xyz);
  RedmapHit hit;
  hit.triangle = number;
  hit.to_viewer = -redmap_to_object(normalize(unnormalised));
  redmap_complete(number, eye, -hit.to_viewer, hit);
  hit.turned = dot(hit.geometric, hit.to_viewer) < 0.0;
  if (hit.turned) {
    hit.normal = -hit.normal;
    hit.geometric = -hit.geometric;
#ifdef REDMAP_POSED
    hit.rest_normal = -hit.rest_normal;
#endif
  }
  redmap_find_footprint(unnormalised, eye, hit);
  return hit;
}
