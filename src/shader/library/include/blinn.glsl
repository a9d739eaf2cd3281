// Blinn's lobe of the half vector (Blinn 1977), normalised as a distribution of microfacets, in the shading frame.
#ifndef REDMAP_BLINN_GLSL
#define REDMAP_BLINN_GLSL

// (e + 2) / 2 pi makes the integral of the lobe times the half vector's cosine 1; a quarter of it is the reflection of
// such facets at a mirror-like view, without shadowing.
float blinn_lobe(float exponent, vec3 to_light, vec3 to_viewer) {
  vec3 half_vector = to_light + to_viewer;
  float cosine = half_vector.z * inversesqrt(max(dot(half_vector, half_vector), 1e-12));
  return (exponent + 2.0) * (0.125 / pi) * pow(clamp(cosine, 0.0, 1.0), exponent);
}

#endif
