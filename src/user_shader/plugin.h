/* The native door for shaders: what a shared library offers to be named in a scene, shader = "mine.so" (docs/
 * bring_your_shader.md). Plain C; nothing else of redmap is needed to build one.
 *
 * Everything comes in batches, one array a coordinate. Arrays belong to redmap; functions are called from several
 * threads at once, keep nothing, and must not fail. Results must be finite numbers: redmap checks them. */
#ifndef REDMAP_PLUGIN_H
#define REDMAP_PLUGIN_H

#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Of this file: a plug-in of another version is refused. */
#define REDMAP_PLUGIN_VERSION 1

/* Places on the surface at rest, object space. Normals and tangents are unit vectors, perpendicular to each other. */
typedef struct RedmapPlaces {
  size_t count;
  const float* position[3];
  const float* normal[3];
  const float* tangent[3];
  const float* uv[2];
  float time; /* seconds, the same for all */
} RedmapPlaces;

/* Pairs of unit vectors away from the surface, in the shading frame: z is the shading normal, x the tangent. */
typedef struct RedmapPairs {
  size_t count;
  const float* to_light[3];
  const float* to_viewer[3];
} RedmapPairs;

typedef struct RedmapPlugin {
  int version; /* REDMAP_PLUGIN_VERSION */

  /* One comment line that says what it is, then `struct Parameters`, declared as in a GLSL shader. Values arrive as
   * `parameters`: all components in the order declared, whole numbers as floats too. */
  const char* declaration;

  size_t pattern_size; /* bytes a pattern takes: plain data, which redmap may copy and move */
  int varies_in_time;  /* whether RedmapPlaces.time is looked at */

  /* Writes a pattern for each place: patterns + i * pattern_size. */
  void (*bind)(const float* parameters, const RedmapPlaces* places, void* patterns);

  /* Radiance towards the viewer under a light of unit irradiance at normal incidence, cosine included. Pair i meets
   * pattern i, or always the first where `one_pattern` is not 0. */
  void (*radiance)(const float* parameters, const void* patterns, int one_pattern, const RedmapPairs* pairs,
                   float* const rgb[3]);

  /* Optional, null where there is none. Light from behind that passes straight through, 0 to 1. */
  void (*transmittance)(const float* parameters, const void* patterns, size_t count, float* const rgb[3]);
  /* Optional. Light of its own. */
  void (*emission)(const float* parameters, const void* patterns, size_t count, float* const rgb[3]);
  /* Optional. Shading normals, object space, unit. */
  void (*shading_normal)(const float* parameters, const RedmapPlaces* places, float* const normal[3]);
} RedmapPlugin;

/* What the shared library exports. Called once; the result must live as long as the library. */
typedef const RedmapPlugin* (*RedmapPluginEntry)(void);
const RedmapPlugin* redmap_plugin(void);

#ifdef __cplusplus
}
#endif
#endif
