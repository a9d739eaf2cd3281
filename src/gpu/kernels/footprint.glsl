// Which part of a sample is the map's, and how far normals turn under it (render/filtered_shading.cpp,
// render/map_shading.cpp).
struct RedmapAxes {
  float major, minor;
  vec2 major_uv;  // along the major axis, over the footprint once
};

// Singular values of the footprint in texels, as map/lookup_plan.cpp.
RedmapAxes redmap_axes(vec2 duv_dx, vec2 duv_dy) {
  vec2 x = duv_dx * redmap_map.xy, y = duv_dy * redmap_map.xy;
  float uu = x.x * x.x + y.x * y.x, uv = x.x * x.y + y.x * y.y, vv = x.y * x.y + y.y * y.y;
  float half_difference = 0.5 * (uu - vv);
  float root = sqrt(half_difference * half_difference + uv * uv);
  float major = sqrt(0.5 * (uu + vv) + root);
  vec2 direction = half_difference >= 0.0 ? vec2(half_difference + root, uv) : vec2(uv, root - half_difference);
  float norm = length(direction);
  vec2 spanned = norm > 0.0 ? direction * (major / norm) : vec2(major, 0.0);
  float minor = major > 0.0 ? abs(x.x * y.y - x.y * y.x) / major : 0.0;
  return RedmapAxes(major, minor, spanned / redmap_map.xy);
}

// The part that the map has in a sample: the rest is the shader itself.
float redmap_part(RedmapAxes axes) {
  return clamp((axes.major - redmap_blend_begin) / (redmap_blend_end - redmap_blend_begin), 0.0, 1.0);
}

// How the interpolated normal turns over the footprint, a box, from one side to the other, in the shading frame: x and y
// along the picture's x, then along its y.
vec4 redmap_turning(RedmapHit hit) {
  vec3 bitangent = cross(hit.normal, hit.tangent);
  vec3 along_x = hit.dn_du * hit.duv_dx.x + hit.dn_dv * hit.duv_dx.y;
  vec3 along_y = hit.dn_du * hit.duv_dy.x + hit.dn_dv * hit.duv_dy.y;
  vec4 turning = vec4(dot(along_x, hit.tangent), dot(along_x, bitangent), dot(along_y, hit.tangent), dot(along_y, bitangent));
  float variance = dot(turning, turning) / 12.0;
  return turning * sqrt(min(1.0, redmap_largest_turn / max(variance, 1e-12)));
}

// Its covariance.
vec3 redmap_curvature(RedmapHit hit) {
  vec4 t = redmap_turning(hit);
  return vec3(t.x * t.x + t.z * t.z, t.x * t.y + t.z * t.w, t.y * t.y + t.w * t.w) / 12.0;
}
