// The weights, or other channels, under a footprint: the plan of map/lookup_plan.cpp, its taps by the device's own
// filter. Where the map does not cover all of its texels, they come multiplied by their coverage, which is the channel
// after them.
const int redmap_layers = (REDMAP_CHANNELS + REDMAP_HAS_COVERAGE + 3) / 4;
// Less than half a byte of one texel.
const float redmap_least_coverage = 0.0019;

struct RedmapTexel {
  vec4 channels[redmap_layers];
};
RedmapTexel redmap_tap(vec2 uv, float level) {
  RedmapTexel texel;
  for (int i = 0; i < redmap_layers; i++) texel.channels[i] = textureLod(redmap_texels, vec3(uv, float(i)), level);
  return texel;
}

// Taps of equal weight along the major axis, all on one level.
struct RedmapPlan {
  vec2 first, step;
  float taps, level;
};
RedmapPlan redmap_plan(vec2 uv, RedmapAxes axes) {
  float texel = max(redmap_texel_per_minor * max(axes.minor, axes.major / redmap_lookup_anisotropy), 1.0);
  float rest = sqrt(max(axes.major * axes.major - 3.0 * texel * texel, 0.0));
  bool is_long = rest > 0.5 * texel;
  float taps =
      is_long ? clamp(ceil(rest / (redmap_tap_spacing * texel) + 0.5), 2.0, redmap_max_taps) : 1.0;
  vec2 step = is_long ? axes.major_uv * (rest / (axes.major * sqrt(taps * taps - 1.0))) : vec2(0.0);
  float level = min(float((floatBitsToInt(texel) >> 23) - 127), max(redmap_map.z - 2.0, 0.0));
  float ratio = texel * exp2(-level);
  level += redmap_map.z > 1.0 ? clamp((ratio * ratio - 1.0) / 3.0, 0.0, 1.0) : 0.0;
  return RedmapPlan(uv - step * (0.5 * (taps - 1.0)), step, taps, level);
}

RedmapTexel redmap_taps(RedmapPlan plan) {
  RedmapTexel sum = redmap_tap(plan.first, plan.level);
  for (float i = 1.0; i < plan.taps; i += 1.0) {
    RedmapTexel tap = redmap_tap(plan.first + plan.step * i, plan.level);
    for (int k = 0; k < redmap_layers; k++) sum.channels[k] += tap.channels[k];
  }
  for (int k = 0; k < redmap_layers; k++) sum.channels[k] /= plan.taps;
  return sum;
}

float redmap_coverage(RedmapTexel texel) {
#if REDMAP_HAS_COVERAGE
  return texel.channels[REDMAP_CHANNELS / 4][REDMAP_CHANNELS % 4];
#else
  return 1.0;
#endif
}

// What was looked up about `uv` on `level`, no longer multiplied by coverage.
float[REDMAP_CHANNELS] redmap_weights_of(vec2 uv, float level, RedmapTexel sum) {
#if REDMAP_HAS_COVERAGE
  // Between charts: whatever is nearest, on coarser levels.
  while (redmap_coverage(sum) < redmap_least_coverage && level < redmap_map.z) {
    level += 1.0;
    sum = redmap_tap(uv, level);
  }
#endif
  float weights[REDMAP_CHANNELS];
  float scale = 1.0 / max(redmap_coverage(sum), 1e-6);
  for (int b = 0; b < REDMAP_CHANNELS; b++)
    weights[b] = sum.channels[b / 4][b % 4] * redmap_scales[b / 4][b % 4] * scale;
  return weights;
}

float[REDMAP_CHANNELS] redmap_look_up(vec2 uv, RedmapAxes axes) {
  RedmapPlan plan = redmap_plan(uv, axes);
  return redmap_weights_of(uv, plan.level, redmap_taps(plan));
}
