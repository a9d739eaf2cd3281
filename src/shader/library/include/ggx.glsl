// Microfacet reflection with the GGX distribution (Walter et al. 2007), anisotropic too (Burley 2012), height-correlated
// Smith shadowing (Heitz 2014) and Schlick's Fresnel term, in the shading frame.
#ifndef REDMAP_GGX_GLSL
#define REDMAP_GGX_GLSL

vec3 ggx_lobe(vec3 specular, float alpha, vec3 to_light, vec3 to_viewer) {
  vec3 half_vector = to_light + to_viewer;
  half_vector = half_vector * inversesqrt(max(dot(half_vector, half_vector), 1e-12));
  float alpha2 = alpha * alpha;
  float light_cosine = max(to_light.z, 1e-4);
  float viewer_cosine = max(to_viewer.z, 1e-4);
  float d = half_vector.z * half_vector.z * (alpha2 - 1.0) + 1.0;
  float distribution = alpha2 / (pi * d * d);
  float light_term = sqrt(alpha2 + (1.0 - alpha2) * light_cosine * light_cosine);
  float viewer_term = sqrt(alpha2 + (1.0 - alpha2) * viewer_cosine * viewer_cosine);
  float visibility = 0.5 / (viewer_cosine * light_term + light_cosine * viewer_term);
  float c = 1.0 - max(dot(to_light, half_vector), 0.0);
  float fresnel = c * c * c * c * c;
  return (specular + (vec3(1.0) - specular) * fresnel) * (distribution * visibility);
}

// Roughness alpha.x along the tangent, alpha.y across it. Equal ones give ggx_lobe().
vec3 ggx_anisotropic_lobe(vec3 specular, vec2 alpha, vec3 to_light, vec3 to_viewer) {
  vec3 half_vector = to_light + to_viewer;
  half_vector = half_vector * inversesqrt(max(dot(half_vector, half_vector), 1e-12));
  float light_cosine = max(to_light.z, 1e-4);
  float viewer_cosine = max(to_viewer.z, 1e-4);
  vec3 h = vec3(half_vector.x / alpha.x, half_vector.y / alpha.y, half_vector.z);
  float d = max(dot(h, h), 1e-6);
  float distribution = 1.0 / (pi * alpha.x * alpha.y * d * d);
  float light_term = length(vec3(alpha.x * to_light.x, alpha.y * to_light.y, light_cosine));
  float viewer_term = length(vec3(alpha.x * to_viewer.x, alpha.y * to_viewer.y, viewer_cosine));
  float visibility = 0.5 / (viewer_cosine * light_term + light_cosine * viewer_term);
  float c = 1.0 - max(dot(to_light, half_vector), 0.0);
  float fresnel = c * c * c * c * c;
  return (specular + (vec3(1.0) - specular) * fresnel) * (distribution * visibility);
}

Material ggx_material(vec3 diffuse, vec3 specular, float alpha) {
  return Material(diffuse, specular, vec3(0.0), 1.0, 1.0, 1.0, vec3(alpha * alpha, 0.0, alpha * alpha));
}

#endif
