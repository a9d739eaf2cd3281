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

// Parameters of a place, for pipelines that mip-map parameters instead of reflectance: a Lambert part and one lobe, which
// is a Phong lobe (include/phong.glsl), a GGX one (include/ggx.glsl), or something of each.
struct Material {
  vec3 diffuse;
  vec3 specular;
  vec3 transmittance;
  float exponent;  // of the Phong lobe
  float ggx;       // part of `specular` that is in the GGX lobe
  float grazing;   // reflectance of the GGX lobe at grazing angles
  vec3 roughness;  // squared roughness of the GGX lobe, as a matrix over the shading frame's x and y: xx, xy, yy
};

#endif
