// What every shader text can rely on: the reader of a text puts this in front of it.
#ifndef REDMAP_PRELUDE_GLSL
#define REDMAP_PRELUDE_GLSL

const float pi = 3.14159265;

// A place on the surface at rest, object space; normal and tangent are perpendicular unit vectors, time is in seconds.
struct Surface {
  vec3 position;
  vec3 normal;
  vec3 tangent;
  vec2 uv;
  float time;
};

// Phong parameters of a place, for pipelines that mip-map parameters instead of reflectance.
struct Material {
  vec3 diffuse;
  vec3 specular;
  float exponent;
  vec3 transmittance;
};

#endif
