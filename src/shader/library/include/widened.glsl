// Lobes seen over normals that vary: widened by the covariance of the normals about the mean one, in whose frame all
// directions are. `covariance` is a matrix over that frame's x and y: xx, xy, yy. Nil gives the lobe itself.
#ifndef REDMAP_WIDENED_GLSL
#define REDMAP_WIDENED_GLSL
#include "include/phong.glsl"

// Phong's lobe. A normal that tilts by an angle turns the mirror direction by twice that in the plane of incidence, and
// by twice its cosine across. The sum of both variances is a lobe of two exponents (Ashikhmin and Shirley 2000), with
// the norm that keeps its integral.
float widened_phong_lobe(float exponent, vec3 covariance, vec3 to_light, vec3 to_viewer) {
  float sine2 = to_light.x * to_light.x + to_light.y * to_light.y;
  bool is_upright = sine2 < 1e-12;
  float scale = inversesqrt(max(sine2, 1e-12));
  float x = mix(to_light.x * scale, 1.0, is_upright);
  float y = mix(to_light.y * scale, 0.0, is_upright);

  // Variance of the mirror direction, in the plane and across.
  float own = 1.0 / max(exponent, 1e-3);
  float in_plane = covariance.x * x * x + 2.0 * covariance.y * x * y + covariance.z * y * y;
  float mixed = (covariance.z - covariance.x) * x * y + covariance.y * (x * x - y * y);
  float across = covariance.x * y * y - 2.0 * covariance.y * x * y + covariance.z * x * x;
  float a = own + 4.0 * in_plane;
  float b = 4.0 * to_light.z * mixed;
  float c = own + 4.0 * to_light.z * to_light.z * across;
  float inverse = 1.0 / max(a * c - b * b, 1e-12);

  // The viewer's deviation from the mean mirror direction; a little of all directions where there is none.
  float p = to_light.z * (to_viewer.x * x + to_viewer.y * y) + sqrt(sine2) * to_viewer.z;
  float q = to_viewer.y * x - to_viewer.x * y;
  float form = (c * p * p - 2.0 * b * p * q + a * q * q + 0.5e-9 * (a + c)) * inverse;
  float towards = form / (p * p + q * q + 1e-9);
  float mirror_cosine = 2.0 * to_light.z * to_viewer.z - dot(to_light, to_viewer);
  float norm = sqrt(inverse + 2.0 * (a + c) * inverse + 4.0);
  return norm * (0.5 / pi) * pow(clamp(mirror_cosine, 0.0, 1.0), towards);
}

// GGX's, of squared roughness `roughness` (xx, xy, yy). Variances of slopes are half of squared roughnesses (Olano and
// Baker 2010; for GGX: Kaplanyan et al. 2016).
vec3 widened_ggx_lobe(vec3 specular, float grazing, vec3 roughness, vec3 covariance, vec3 to_light, vec3 to_viewer) {
  vec3 alpha2 = roughness + 2.0 * covariance;
  vec3 half_vector = to_light + to_viewer;
  half_vector = half_vector * inversesqrt(max(dot(half_vector, half_vector), 1e-12));
  float light_cosine = max(to_light.z, 1e-4);
  float viewer_cosine = max(to_viewer.z, 1e-4);
  float determinant = max(alpha2.x * alpha2.z - alpha2.y * alpha2.y, 1e-12);
  vec3 h = half_vector;
  float slopes = (alpha2.z * h.x * h.x - 2.0 * alpha2.y * h.x * h.y + alpha2.x * h.y * h.y) / determinant;
  float d = max(slopes + h.z * h.z, 1e-6);
  float distribution = inversesqrt(determinant) / (pi * d * d);
  vec3 l = to_light;
  vec3 v = to_viewer;
  float light_slopes = alpha2.x * l.x * l.x + 2.0 * alpha2.y * l.x * l.y + alpha2.z * l.y * l.y;
  float viewer_slopes = alpha2.x * v.x * v.x + 2.0 * alpha2.y * v.x * v.y + alpha2.z * v.y * v.y;
  float visibility = 0.5 / (viewer_cosine * sqrt(light_slopes + light_cosine * light_cosine) +
                            light_cosine * sqrt(viewer_slopes + viewer_cosine * viewer_cosine));
  float e = 1.0 - max(dot(to_light, half_vector), 0.0);
  float fresnel = e * e * e * e * e;
  return (specular + (vec3(grazing) - specular) * fresnel) * (distribution * visibility);
}

// A material over such normals. The mean of the normals is shorter than a normal, which darkens what is diffuse.
vec3 widened_radiance(Material m, vec3 covariance, vec3 to_light, vec3 to_viewer) {
  float shortening = inversesqrt(1.0 + covariance.x + covariance.z);
  vec3 phong = m.specular * ((1.0 - m.ggx) * widened_phong_lobe(m.exponent, covariance, to_light, to_viewer));
  vec3 ggx = widened_ggx_lobe(m.specular * m.ggx, m.grazing, m.roughness, covariance, to_light, to_viewer);
  return (m.diffuse * (shortening / pi) + phong + ggx) * visible_cosine(to_light, to_viewer);
}

#endif
