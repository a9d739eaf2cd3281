// Lambert and normalised Phong reflectance in the shading frame (Lafortune and Willems 1994).
#ifndef REDMAP_PHONG_GLSL
#define REDMAP_PHONG_GLSL

// Lobe around the mirror direction whose integral times the cosine is 1 for light from straight above.
float phong_lobe(float exponent, vec3 to_light, vec3 to_viewer) {
  float mirror_cosine = 2.0 * to_light.z * to_viewer.z - dot(to_light, to_viewer);
  return (exponent + 2.0) * (0.5 / pi) * pow(clamp(mirror_cosine, 0.0, 1.0), exponent);
}

// Cosine at the light, zero if light or viewer is below the horizon.
float visible_cosine(vec3 to_light, vec3 to_viewer) {
  return mix(0.0, to_light.z, to_light.z > 0.0 && to_viewer.z > 0.0);
}

vec3 phong_radiance(vec3 diffuse, vec3 specular, float exponent, vec3 to_light, vec3 to_viewer) {
  vec3 reflectance = diffuse * (1.0 / pi) + specular * phong_lobe(exponent, to_light, to_viewer);
  return reflectance * visible_cosine(to_light, to_viewer);
}

Material phong_material(vec3 diffuse, vec3 specular, float exponent) {
  return Material(diffuse, specular, vec3(0.0), exponent, 0.0, 0.0, vec3(0.0));
}

#endif
