// Where light arrives at what the samples see of an object: one sample an invocation, a block of 8 x 8 a workgroup.
layout(local_size_x = 64) in;

void main() {
  uint block = gl_WorkGroupID.x, i = gl_LocalInvocationID.x;
  uvec2 corner = 8u * (redmap_blocks.xy + uvec2(block % redmap_blocks.z, block / redmap_blocks.z));
  uvec2 place = corner + uvec2(i & 7u, i >> 3u);
  if (place.x >= redmap_picture.x || place.y >= redmap_rows) return;
  uint number = texelFetch(redmap_seen, ivec3(place, 0), 0).x - redmap_numbers.x;
  if (number >= redmap_numbers.y) return;
  RedmapHit hit = redmap_hit(number, place);
  vec3 world = redmap_point_to_world(hit.position);
  float away = distance(world, redmap_eye.xyz);
  float width = away * length(redmap_right.xyz) / float(redmap_picture.y);
  float offset = redmap_limits.x + redmap_roundings * max(away, length(world));
  uint here = place.y * redmap_picture.x + place.x;
  redmap_paths[redmap_path(redmap_receiver, here)] = vec4(world + redmap_to_world(hit.geometric) * offset, width);
  for (uint light = 0u; light < redmap_picture.z; light++)
    redmap_paths[redmap_path(redmap_first_light + light, here)] = vec4(1.0);
}
