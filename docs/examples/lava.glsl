// Lava after the fashion of Shadertoy: a warped 3D pattern, with what the gallery writes and redmap's library does not.
#include "include/noise.glsl"

struct Parameters {
  float scale;  // 3 [0.1, 100] 1/unit: cracks per object unit
  float heat;   // 0.5 [0, 1]: how much of the rock glows
};

struct Pattern {
  vec3 rock;
  vec3 glow;
  float gloss;
};

// A Shadertoy's palette: three cosines.
vec3 palette(float t) { return 0.5 + 0.5 * cos(2.0 * pi * (t + vec3(0.0, 0.33, 0.67))); }

float warped(vec3 p, out vec3 where) {
  const mat3 turn = mat3(0.00, 0.80, 0.60, -0.80, 0.36, -0.48, -0.60, -0.48, 0.64);
  where = p;
  for (int i = 0; i < 3; i++) where = turn * where.yzx + 0.4 * sin(where.zxy * 1.7 + float(i));
  float sum = 0.0, amplitude = 0.5;
  for (int i = 0; i < 5; i++, amplitude *= 0.5) sum += amplitude * (1.0 - abs(gradient_noise(where * exp2(float(i)))));
  return sum;
}

Pattern pattern(Surface at, Parameters p) {
  vec3 where;
  float ridge = warped(at.position * p.scale, where);
  float hot = smoothstep(1.0 - 0.25 * p.heat, 1.0 - 0.1 * p.heat, ridge);
  vec3 tint = palette(0.05 * where.x);
  return Pattern(mix(vec3(0.02), vec3(0.10, 0.07, 0.06), tint.r), hot * vec3(2.4, 0.6, 0.08), hot > 0.5 ? 0.0 : 0.3);
}

vec3 radiance(Pattern m, vec3 to_light, vec3 to_viewer) {
  if (min(to_light.z, to_viewer.z) <= 0.0) return vec3(0.0);
  vec3 h = normalize(to_light + to_viewer);
  return (m.rock / pi + m.gloss * pow(h.z, 60.0)) * to_light.z;
}

vec3 emission(Pattern m) { return m.glow; }
