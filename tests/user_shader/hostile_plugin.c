/* A plug-in that does what the environment asks for. */
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <user_shader/plugin.h>

static int asked(const char* what) {
  const char* sin = getenv("HOSTILE_PLUGIN");
  return sin && strcmp(sin, what) == 0;
}

static void bind(const float* parameters, const RedmapPlaces* places, void* patterns) {
  (void)parameters;
  memset(patterns, 0, places->count);
}

static void radiance(const float* parameters, const void* patterns, int one_pattern, const RedmapPairs* pairs,
                     float* const rgb[3]) {
  (void)parameters, (void)patterns, (void)one_pattern;
  for (int c = 0; c < 3; ++c)
    for (size_t i = 0; i < pairs->count; ++i) rgb[c][i] = asked("nan") ? NAN : 0;
}

static void shading_normal(const float* parameters, const RedmapPlaces* places, float* const normal[3]) {
  (void)parameters;
  for (int c = 0; c < 3; ++c) memset(normal[c], 0, places->count * sizeof(float));
}

const RedmapPlugin* redmap_plugin(void) {
  static RedmapPlugin plugin;
  plugin.version = asked("version") ? 99 : REDMAP_PLUGIN_VERSION;
  plugin.declaration = asked("declaration") ? "struct Parameters {\n  float a;\n};\n"
                                            : "struct Parameters {\n  float a;  // 0 [0, 1]: nothing\n};\n";
  plugin.pattern_size = asked("size") ? 0 : 1;
  plugin.bind = bind;
  plugin.radiance = asked("null") ? NULL : radiance;
  plugin.shading_normal = asked("normal") ? shading_normal : NULL;
  return asked("nothing") ? NULL : &plugin;
}
