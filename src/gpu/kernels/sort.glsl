// Sorts the samples that see an object, a block of 8 x 8 an invocation, so that neighbours stay together and those that
// have the same work lie side by side. Lists come in any order of blocks; what a sample becomes does not depend on it.
layout(local_size_x = 64) in;

// One of the lists above for the two kinds of work that a sample may need; 3: none.
uvec2 lists_of(uint number, uvec2 place) {
  if (redmap_filters == 0u) return uvec2(redmap_near, 3u);
  RedmapHit hit = redmap_hit(number, place);
  float part = redmap_part(redmap_axes(hit.duv_dx, hit.duv_dy));
  vec3 turn = redmap_curvature(hit);
  uint filtered = turn.x + turn.z > redmap_map.w ? redmap_spread : redmap_far;
  return uvec2(part < 1.0 ? redmap_near : 3u, part > 0.0 ? filtered : 3u);
}

void main() {
  uint block = gl_GlobalInvocationID.x;
  if (block >= redmap_blocks.w) return;
  uvec2 corner = 8u * (redmap_blocks.xy + uvec2(block % redmap_blocks.z, block / redmap_blocks.z));
  uvec2 lists[3] = uvec2[3](uvec2(0u), uvec2(0u), uvec2(0u));  // which of the 64 samples
  for (uint i = 0u; i < 64u; i++) {
    uvec2 place = corner + uvec2(i & 7u, i >> 3u);
    if (place.x >= redmap_picture.x || place.y >= redmap_rows) continue;
    uint number = texelFetch(redmap_seen, ivec3(place, 0), 0).x - redmap_numbers.x;
    if (number >= redmap_numbers.y) continue;
    uvec2 chosen = lists_of(number, place);
    uvec2 bit = i < 32u ? uvec2(1u << i, 0u) : uvec2(0u, 1u << (i - 32u));
    lists[0] |= chosen.x == redmap_near ? bit : uvec2(0u);
    lists[1] |= chosen.y == redmap_far ? bit : uvec2(0u);
    lists[2] |= chosen.y == redmap_spread ? bit : uvec2(0u);
  }
  uint all = redmap_picture.x * redmap_rows;
  for (uint list = 0u; list < 3u; list++) {
    uvec2 bits = lists[list];
    uint count = uint(bitCount(bits.x) + bitCount(bits.y));
    if (count == 0u) continue;
    uint next = atomicAdd(redmap_counts[list], count);
    while ((bits.x | bits.y) != 0u) {
      uint i = bits.x != 0u ? uint(findLSB(bits.x)) : 32u + uint(findLSB(bits.y));
      if (bits.x != 0u)
        bits.x &= bits.x - 1u;
      else
        bits.y &= bits.y - 1u;
      uint to = list == redmap_near ? next : (list == redmap_far ? all + next : 2u * all - 1u - next);
      bool is_both = list != redmap_near && ((i < 32u ? lists[0].x >> i : lists[0].y >> (i - 32u)) & 1u) != 0u;
      redmap_samples[to] = (is_both ? redmap_in_both : 0u) | ((corner.y + (i >> 3u)) * redmap_picture.x + corner.x + (i & 7u));
      next++;
    }
  }
}
