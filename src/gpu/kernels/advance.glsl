// Samples go on behind what they saw, as far as it lets light pass; those that saw nothing take the background.
layout(local_size_x = 64) in;
layout(std430, binding = 1) writeonly buffer RedmapOnward { uint redmap_onward; };  // set where any sample goes on
layout(binding = 10) uniform usampler2DArray redmap_seen;
layout(binding = 11) uniform sampler2DArray redmap_seen_depth;

void main() {
  uint i = gl_GlobalInvocationID.x;
  if (i >= redmap_picture.x * redmap_rows) return;
  vec4 through = redmap_paths[redmap_path(redmap_through, i)];
  if (through.w <= 0.0) return;
  ivec3 place = ivec3(redmap_place_of(i), 0);
  vec3 onward = vec3(0.0);
  if (texelFetch(redmap_seen, place, 0).x == 0u)
    for (uint c = 0u; c < 3u; c++) redmap_radiance[3u * i + c] += through[c] * redmap_background[c];
  else
    onward = through.xyz * redmap_paths[redmap_path(redmap_behind, i)].xyz;
  bool goes_on = max(onward.x, max(onward.y, onward.z)) >= redmap_least_throughput;
  redmap_paths[redmap_path(redmap_through, i)] =
      goes_on ? vec4(onward, texelFetch(redmap_seen_depth, place, 0).x) : vec4(0.0);
  if (goes_on) redmap_onward = 1u;
}
