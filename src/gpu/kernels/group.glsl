// Turns the counts of the lists into workgroups, and clears them for the next object.
layout(local_size_x = 1) in;

void main() {
  for (uint list = 0u; list < 3u; list++) {
    uint count = redmap_counts[list];
    redmap_groups[list] = uvec4((count + 63u) / 64u, 1u, 1u, count);
    redmap_counts[list] = 0u;
  }
}
