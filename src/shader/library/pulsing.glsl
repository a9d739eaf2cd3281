// Embers that pulse: cracks in a dark crust glow and fade in time, so that no map can stand in for it.
#include "include/noise.glsl"
#include "include/phong.glsl"

struct Parameters {
  float scale;      // 6 [0.1, 1000] 1/unit: cracks per object unit
  float frequency;  // 0.5 [0, 100] Hz: pulses a second
  vec3 glow;        // 1 0.35 0.06 [0, 10]: radiance of the cracks at their brightest
};

struct Pattern {
  vec3 diffuse;
  vec3 specular;
  float exponent;
  vec3 emission;
};

Pattern pattern(Surface at, Parameters p) {
  float crack = 1.0 - smoothstep(0.0, 0.25, turbulence(at.position * p.scale, 4));
  float pulse = 0.5 + 0.5 * sin(2.0 * pi * (p.frequency * at.time + gradient_noise(at.position * 1.7)));
  Pattern m;
  m.diffuse = vec3(0.06, 0.05, 0.05) * (1.0 - crack);
  m.specular = vec3(0.08);
  m.exponent = 12.0;
  m.emission = p.glow * (crack * (0.2 + 0.8 * pulse));
  return m;
}

vec3 radiance(Pattern m, vec3 to_light, vec3 to_viewer) {
  return phong_radiance(m.diffuse, m.specular, m.exponent, to_light, to_viewer);
}

vec3 emission(Pattern m) { return m.emission; }

Material material(Pattern m) { return phong_material(m.diffuse, m.specular, m.exponent); }
