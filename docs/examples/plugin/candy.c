/* Candy stripes as a plug-in: two colours around the axis under one hard sugar coat. */
#include <math.h>
#include <user_shader/plugin.h>

static const char kDeclaration[] =
    "// Candy stripes under a sugar coat.\n"
    "struct Parameters {\n"
    "  int stripes;  // 8 [1, 100]: around the axis\n"
    "  float twist;  // 3 [-100, 100] 1/unit: stripes passed per object unit of height\n"
    "  vec3 colour;  // 0.7 0.02 0.05 [0, 1]: of every second stripe\n"
    "};\n";

typedef struct Pattern {
  float diffuse[3];
} Pattern;

static const float kPi = 3.14159265f;

static void bind(const float* parameters, const RedmapPlaces* places, void* patterns) {
  Pattern* out = patterns;
  for (size_t i = 0; i < places->count; ++i) {
    const float angle = atan2f(places->position[2][i], places->position[0][i]);
    const float stripe = angle / (2 * kPi) * parameters[0] + places->position[1][i] * parameters[1];
    const int is_white = stripe - floorf(stripe) < 0.5f;
    for (int c = 0; c < 3; ++c) out[i].diffuse[c] = is_white ? 0.85f : parameters[2 + c];
  }
}

static void radiance(const float* parameters, const void* patterns, int one_pattern, const RedmapPairs* pairs,
                     float* const rgb[3]) {
  const Pattern* pattern = patterns;
  (void)parameters;
  for (size_t i = 0; i < pairs->count; ++i) {
    const Pattern* p = one_pattern ? pattern : pattern + i;
    const float light = pairs->to_light[2][i], viewer = pairs->to_viewer[2][i];
    float h[3], length = 0;
    for (int c = 0; c < 3; ++c) {
      h[c] = pairs->to_light[c][i] + pairs->to_viewer[c][i];
      length += h[c] * h[c];
    }
    const float cosine = length > 1e-12f ? fmaxf(h[2] / sqrtf(length), 0) : 0;
    const float coat = 0.6f * powf(cosine, 150);
    for (int c = 0; c < 3; ++c) rgb[c][i] = light > 0 && viewer > 0 ? (p->diffuse[c] / kPi + coat) * light : 0;
  }
}

const RedmapPlugin* redmap_plugin(void) {
  static const RedmapPlugin kPlugin = {
      .version = REDMAP_PLUGIN_VERSION,
      .declaration = kDeclaration,
      .pattern_size = sizeof(Pattern),
      .bind = bind,
      .radiance = radiance,
  };
  return &kPlugin;
}
