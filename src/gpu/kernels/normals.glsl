// The distributions of normals under a footprint: map/normal_gather.cpp, a texel at a time. Their bytes follow the drawn
// normals in the data, after the byte at which each level starts.
const uint redmap_normals_first = redmap_rest_first;
const uint redmap_normal_levels = 16u;

uint redmap_byte(uint at) {
  return (redmap_word(redmap_normals_first + redmap_normal_levels + (at >> 2u)) >> (8u * (at & 3u))) & 255u;
}
// Standard deviations from .001 to 1 on a logarithmic scale; 0 is none.
float redmap_unpacked_variance(uint b) {
  float deviation = 1e-3 * exp(float(int(b) - 1) * (6.90775528 / 254.0));
  return b == 0u ? 0.0 : deviation * deviation;
}
RedmapNormals redmap_unpack(uint at) {
  uint b1 = redmap_byte(at + 1u);
  vec2 mean = vec2(float(int(redmap_byte(at) | (b1 & 15u) << 8u)), float(int(b1 >> 4u | redmap_byte(at + 2u) << 4u)));
  float larger = redmap_unpacked_variance(redmap_byte(at + 3u)), smaller = redmap_unpacked_variance(redmap_byte(at + 4u));
  float twice = 2.0 * 3.14159265 * float(redmap_byte(at + 5u)) / 256.0;
  float half_sum = 0.5 * (larger + smaller), half_difference = 0.5 * (larger - smaller);
  float along = half_difference * cos(twice);
  return RedmapNormals((mean - 2048.0) / 2047.0, vec3(half_sum + along, half_difference * sin(twice), half_sum - along));
}

// Of the texel at `place`: its column on the level, how much of it is under the footprint, and its channels.
float redmap_area(RedmapPatch patch_, ivec2 place, out int column, out RedmapTexel texel) {
  column = redmap_column(patch_, place.x);
  for (int i = 0; i < redmap_layers; i++)
    texel.channels[i] = texelFetch(redmap_texels, ivec3(column, place.y, i), int(patch_.level));
  return redmap_overlap(patch_, place);
}
// Where the distributions of a texel are; each of those beyond the base has a share and weights of its own.
uint redmap_normals_at(RedmapPatch patch_, int column, int row) {
  uint size = patch_.level == 0u ? 6u : 2u * (7u + uint(REDMAP_BASIS));
  return redmap_word(redmap_normals_first + patch_.level) + size * uint(row * patch_.extent.x + column);
}

// Mean normal of a texel of the base; false where nothing is covered, whose bytes are zero.
bool redmap_mean_at(ivec2 place, out vec2 mean) {
  ivec2 extent = ivec2(redmap_map.xy);
  mean = vec2(0.0);
  if (REDMAP_WRAPS != 0) place.x = (place.x + extent.x) % extent.x;
  if (place.x < 0 || place.x >= extent.x || place.y < 0 || place.y >= extent.y) return false;
  uint at = redmap_word(redmap_normals_first) + 6u * uint(place.y * extent.x + place.x);
  uint b1 = redmap_byte(at + 1u), x = redmap_byte(at) | (b1 & 15u) << 8u, y = b1 >> 4u | redmap_byte(at + 2u) << 4u;
  mean = (vec2(float(int(x)), float(int(y))) - 2048.0) / 2047.0;
  return x != 0u;
}
// The smaller of two differences where they have the same sign: an edge is no slope.
float redmap_limited(float a, float b) { return a * b <= 0.0 ? 0.0 : abs(a) < abs(b) ? a : b; }
vec2 redmap_slope(ivec2 place, ivec2 along) {
  vec2 before, here, after;
  if (!redmap_mean_at(place - along, before) || !redmap_mean_at(place, here) || !redmap_mean_at(place + along, after))
    return vec2(0.0);
  return vec2(redmap_limited(here.x - before.x, after.x - here.x), redmap_limited(here.y - before.y, after.y - here.y));
}
// What an interval of half-length `reach` around `a` has in [-1/2, 1/2]: where its middle went, and what was taken off
// the square of its length.
vec2 redmap_cut_interval(float a, float reach) {
  float low = max(a - reach, -0.5), high = min(a + reach, 0.5);
  float part = (high - low) / (2.0 * reach);
  return vec2(0.5 * (low + high) - a, 1.0 - part * part);
}
// The normals of the part of a texel of the base that a footprint has.
RedmapNormals redmap_cut(RedmapNormals normals, RedmapPatch patch_, ivec2 place, int column) {
  vec2 offset = vec2(place) + 0.5 - patch_.centre;
  vec2 a = redmap_cut_interval(dot(patch_.to_a, offset), patch_.half_a);
  vec2 b = redmap_cut_interval(dot(patch_.to_b, offset), patch_.half_b);
  if (patch_.level > 0u || (a.y <= 0.0 && b.y <= 0.0)) return normals;
  // The footprint's sides, in texels.
  float determinant = patch_.to_a.x * patch_.to_b.y - patch_.to_a.y * patch_.to_b.x;
  vec2 dx = vec2(patch_.to_b.y, -patch_.to_b.x) / determinant, dy = vec2(-patch_.to_a.y, patch_.to_a.x) / determinant;
  vec2 middle = dx * a.x + dy * b.x;
  vec2 across = redmap_slope(ivec2(column, place.y), ivec2(1, 0)), up = redmap_slope(ivec2(column, place.y), ivec2(0, 1));
  normals.mean += across * middle.x + up * middle.y;
  vec3 linear = vec3(across.x * across.x + up.x * up.x, across.x * across.y + up.x * up.y,
                     across.y * across.y + up.y * up.y) / 12.0;
  float most = min(1.0, min(normals.covariance.x / max(linear.x, 1e-12), normals.covariance.z / max(linear.z, 1e-12)));
  normals.covariance -= 0.5 * (a.y + b.y) * most * linear;
  float bound = sqrt(max(0.0, normals.covariance.x * normals.covariance.z));
  normals.covariance.y = clamp(normals.covariance.y, -bound, bound);
  return normals;
}

// Area that is covered, weighted by coverage.
float redmap_covered(RedmapPatch patch_) {
  float total = 0.0;
  for (int y = patch_.from.y; y <= patch_.to.y; y++)
    for (int x = patch_.from.x; x <= patch_.to.x; x++) {
      int column;
      RedmapTexel texel;
      float area = redmap_area(patch_, ivec2(x, y), column, texel);
      total += area * redmap_coverage(texel);
    }
  return total;
}

// The distributions under a footprint, and the parts of both levels; nil where nothing is covered.
struct RedmapGather {
  RedmapPatch fine, coarse;
  vec2 part;
};
RedmapGather redmap_gather(RedmapHit hit, RedmapAxes axes) {
  RedmapGatherPlan plan = redmap_gather_plan(hit, axes, redmap_gathered_texels);
  float coarse = plan.coarse_part;
  float fine_area = coarse < 1.0 ? redmap_covered(plan.fine) : 0.0;
  float coarse_area = coarse > 0.0 ? redmap_covered(plan.coarse) : 0.0;
  return RedmapGather(plan.fine, plan.coarse,
                      vec2(fine_area > 0.0 ? (1.0 - coarse) / fine_area : 0.0,
                           coarse_area > 0.0 ? (fine_area > 0.0 ? coarse : 1.0) / coarse_area : 0.0));
}
