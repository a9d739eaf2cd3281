// Ridges around the y axis: flanks of one slope, rounded at ridge and groove, of one glossy plastic.
#include "include/bump.glsl"
#include "include/phong.glsl"

struct Parameters {
  float rows;      // 16 [0.1, 1000] 1/unit: ridges per object unit of height
  float slope;     // 0.35 [0, 2]: slope of the flanks
  float exponent;  // 100 [1, 1000]: Phong exponent of the plastic
  vec3 paint;      // 0.1 0.3 0.4 [0, 1]: diffuse colour
};

struct Pattern {
  vec3 diffuse;
  float exponent;
};

Pattern pattern(Surface at, Parameters p) { return Pattern(p.paint, p.exponent); }

vec3 shading_normal(Surface at, Parameters p) {
  // A cosine cut off at a quarter of its height: five sixths of a ridge are straight flanks.
  float flank = clamp(4.0 * cos(2.0 * pi * at.position.y * p.rows), -1.0, 1.0);
  vec3 fine = 0.05 * unit_bumps(at.position * (4.0 * p.rows), 3);
  return bumped_normal(at.normal, vec3(0.0, p.slope * flank, 0.0) + fine);
}

vec3 radiance(Pattern m, vec3 to_light, vec3 to_viewer) {
  return phong_radiance(m.diffuse, vec3(0.3), m.exponent, to_light, to_viewer);
}

Material material(Pattern m) { return phong_material(m.diffuse, vec3(0.3), m.exponent); }
