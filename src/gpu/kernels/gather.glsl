// Raw texels under a footprint, each by the area that the footprint has of it: map/footprint_texels.cpp.

// What is gathered on one level: texels [from, to], and how footprint coordinates come from them.
struct RedmapPatch {
  ivec2 from, to, extent;
  vec2 centre, to_a, to_b;
  float half_a, half_b;
  uint level;
};
RedmapPatch redmap_patch(uint level, vec2 uv, vec2 duv_dx, vec2 duv_dy) {
  RedmapPatch patch_;
  patch_.level = level;
  patch_.extent = max(ivec2(redmap_map.xy) >> int(level), ivec2(1));
  vec2 size = vec2(patch_.extent), dx = duv_dx * size, dy = duv_dy * size;
  float determinant = dx.x * dy.y - dx.y * dy.x;
  patch_.to_a = vec2(dy.y, -dy.x) / determinant;
  patch_.to_b = vec2(-dx.y, dx.x) / determinant;
  patch_.half_a = 0.5 * (abs(patch_.to_a.x) + abs(patch_.to_a.y));
  patch_.half_b = 0.5 * (abs(patch_.to_b.x) + abs(patch_.to_b.y));
  patch_.centre = uv * size;
  vec2 reach = 0.5 * (abs(dx) + abs(dy)) + 0.5;
  // Beyond the edge on either side lies a texel that is not there, or a turn of those that are.
  ivec2 low = ivec2(REDMAP_WRAPS != 0 ? -patch_.extent.x : -1, -1);
  ivec2 high = ivec2(REDMAP_WRAPS != 0 ? 2 * patch_.extent.x : patch_.extent.x, patch_.extent.y);
  patch_.from = ivec2(clamp(floor(patch_.centre - reach), vec2(low), vec2(high)));
  patch_.to = ivec2(clamp(floor(patch_.centre + reach), vec2(low), vec2(high)));
  patch_.from.y = max(patch_.from.y, 0);
  patch_.to.y = min(patch_.to.y, patch_.extent.y - 1);
  if (REDMAP_WRAPS != 0) {
    patch_.to.x = min(patch_.to.x, patch_.from.x + patch_.extent.x - 1);
  } else {
    patch_.from.x = max(patch_.from.x, 0);
    patch_.to.x = min(patch_.to.x, patch_.extent.x - 1);
  }
  return patch_;
}

float redmap_overlap(float a, float reach) { return max(min(a + reach, 0.5) - max(a - reach, -0.5), 0.0); }

// The levels under a footprint, and the part that the coarser has.
struct RedmapGatherPlan {
  RedmapPatch fine, coarse;
  float coarse_part;
};
// On the level where `texels` to twice as many lie across it; widened where it is too narrow.
RedmapGatherPlan redmap_gather_plan(RedmapHit hit, RedmapAxes axes, float texels) {
  float width = max(max(axes.minor, axes.major / redmap_gather_anisotropy), redmap_gather_least_width);
  vec2 dx = hit.duv_dx, dy = hit.duv_dy;
  if (width > axes.minor) {
    vec2 along = axes.major_uv * redmap_map.xy;
    along = dot(along, along) > 0.0 ? normalize(along) : vec2(1.0, 0.0);
    dx = along * max(axes.major, width) / redmap_map.xy;
    dy = vec2(-along.y, along.x) * width / redmap_map.xy;
  }
  float position = clamp(log2(max(width / texels, 1.0)), 0.0, redmap_map.z - 1.0);
  float level = min(floor(position), max(redmap_map.z - 2.0, 0.0));
  RedmapGatherPlan plan;
  plan.coarse_part = clamp((position - level - redmap_gather_blend_from) / (1.0 - redmap_gather_blend_from), 0.0, 1.0);
  plan.fine = redmap_patch(uint(level), hit.uv, dx, dy);
  plan.coarse = redmap_patch(min(uint(level) + 1u, uint(redmap_map.z) - 1u), hit.uv, dx, dy);
  return plan;
}

// The column of a texel on its level, and how much of it is under the footprint.
int redmap_column(RedmapPatch patch_, int x) {
  return REDMAP_WRAPS != 0 ? ((x % patch_.extent.x) + patch_.extent.x) % patch_.extent.x : x;
}
float redmap_overlap(RedmapPatch patch_, ivec2 place) {
  vec2 offset = vec2(place) + 0.5 - patch_.centre;
  return redmap_overlap(dot(patch_.to_a, offset), patch_.half_a) * redmap_overlap(dot(patch_.to_b, offset), patch_.half_b);
}
