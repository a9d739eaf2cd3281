// Ward's anisotropic reflection (Ward 1992) in the shading frame.
#ifndef REDMAP_WARD_GLSL
#define REDMAP_WARD_GLSL

// Widths alpha.x along the tangent, alpha.y across it: standard deviations of the slope times the square root of two.
vec3 ward_lobe(vec3 specular, vec2 alpha, vec3 to_light, vec3 to_viewer) {
  vec3 h = to_light + to_viewer;
  float z = max(h.z, 1e-4);
  float x = h.x / (alpha.x * z);
  float y = h.y / (alpha.y * z);
  float light_cosine = max(to_light.z, 1e-4);
  float viewer_cosine = max(to_viewer.z, 1e-4);
  float geometry = inversesqrt(light_cosine * viewer_cosine);
  return specular * (exp(-(x * x + y * y)) * geometry / (4.0 * pi * alpha.x * alpha.y));
}

#endif
