// Orange enamel on blue glass: light passes through where the enamel leaves the glass bare.
#include "include/noise.glsl"
#include "include/phong.glsl"

struct Parameters {
  float scale;      // 12 [0.1, 1000] 1/unit: cells per object unit
  float threshold;  // 0.02 [-1, 1]: height of the noise above which there is enamel
  vec3 enamel;      // 0.7 0.3 0.08 [0, 1]: diffuse colour of the enamel
  vec3 glass;       // 0.55 0.75 0.85 [0, 1]: part of the light that passes through the glass
};

struct Pattern {
  vec3 diffuse;
  vec3 specular;
  float exponent;
  vec3 transmittance;
};

Pattern pattern(Surface at, Parameters p) {
  bool is_enamel = gradient_noise(at.position * p.scale + vec3(31.4)) > p.threshold;
  Pattern m;
  m.diffuse = mix(vec3(0.02, 0.03, 0.04), p.enamel, bvec3(is_enamel));
  m.specular = vec3(mix(0.2, 0.1, is_enamel));
  m.exponent = mix(100.0, 30.0, is_enamel);
  m.transmittance = mix(p.glass, vec3(0.0), bvec3(is_enamel));
  return m;
}

vec3 radiance(Pattern m, vec3 to_light, vec3 to_viewer) {
  return phong_radiance(m.diffuse, m.specular, m.exponent, to_light, to_viewer);
}

vec3 transmittance(Pattern m) { return m.transmittance; }

Material material(Pattern m) {
  Material exported = phong_material(m.diffuse, m.specular, m.exponent);
  exported.transmittance = m.transmittance;
  return exported;
}
