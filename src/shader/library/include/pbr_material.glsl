// A material instead of a reflectance: include this after struct Parameters, and define
//   PbrMaterial material_at(Surface at, Parameters p)
// The rest of a shader is here: the metallic-roughness reflectance of glTF 2.0 (its appendix B), which OpenPBR's base
// and specular layers come down to. A shader whose material glows also defines emission() as { return m.emission; }.
#ifndef REDMAP_PBR_MATERIAL_GLSL
#define REDMAP_PBR_MATERIAL_GLSL
#include "include/ggx.glsl"
#include "include/phong.glsl"

struct PbrMaterial {
  vec3 base_color;  // linear; OpenPBR: base_color
  float metallic;   // 0 or 1, or a mixture of both; OpenPBR: base_metalness
  float roughness;  // as artists see it, the square root of GGX's; OpenPBR: specular_roughness
  vec3 normal;      // of a normal map, in the frame of tangent, bitangent and normal; (0, 0, 1) changes nothing
  vec3 emission;    // OpenPBR: emission_color * emission_luminance
};

PbrMaterial material_at(Surface at, Parameters p);

// Nothing special: white, rough, no metal.
PbrMaterial default_material() { return PbrMaterial(vec3(0.8), 0.0, 0.5, vec3(0.0, 0.0, 1.0), vec3(0.0)); }

struct Pattern {
  vec3 diffuse;
  vec3 specular;  // reflectance at normal incidence
  float alpha;
  vec3 emission;
};

Pattern pattern(Surface at, Parameters p) {
  PbrMaterial m = material_at(at, p);
  // 0.04: glTF's reflectance of what is no metal, an index of refraction of 1.5. Under 0.001 highlights are no wider than
  // rounding.
  return Pattern(m.base_color * (1.0 - m.metallic), mix(vec3(0.04), m.base_color, m.metallic),
                 max(m.roughness * m.roughness, 1e-3), m.emission);
}

vec3 radiance(Pattern m, vec3 to_light, vec3 to_viewer) {
  vec3 half_vector = to_light + to_viewer;
  half_vector = half_vector * inversesqrt(max(dot(half_vector, half_vector), 1e-12));
  float c = 1.0 - max(dot(to_light, half_vector), 0.0);
  vec3 fresnel = m.specular + (vec3(1.0) - m.specular) * (c * c * c * c * c);
  vec3 reflectance =
      (vec3(1.0) - fresnel) * m.diffuse * (1.0 / pi) + ggx_lobe(m.specular, m.alpha, to_light, to_viewer);
  return reflectance * visible_cosine(to_light, to_viewer);
}

Material material(Pattern m) { return ggx_material(m.diffuse, m.specular, m.alpha); }

#endif
