// Production cost: a varnished plank with rings, fibres, pores and worn varnish. The trunk runs along y.
#include "include/two_lobes.glsl"
#include "include/worley.glsl"

struct Parameters {
  float rings;   // 9 [0.1, 1000] 1/unit: year rings per object unit
  float wobble;  // 0.12 [0, 2] unit: how far the rings stray from circles
  float pores;   // 26 [1, 1000] 1/unit: pores per object unit across the trunk
  float wear;    // 0.1 [-2, 2]: how much of the varnish is gone, more for larger values
  vec3 early;    // 0.55 0.34 0.16 [0, 1]: diffuse colour of the spring wood
  vec3 late;     // 0.26 0.12 0.05 [0, 1]: diffuse colour of the autumn wood
  vec3 pore;     // 0.07 0.035 0.02 [0, 1]: diffuse colour of the pores
};

struct Pattern {
  Coating coating;
};

vec3 fbm3(vec3 p) { return vec3(fbm(p, 8), fbm(p + vec3(31.7), 8), fbm(p + vec3(67.1), 8)); }

Pattern pattern(Surface at, Parameters p) {
  // Rings around a trunk whose axis lies beside the object, bent along their length.
  vec3 slow = at.position * vec3(1.4, 0.35, 1.4);
  vec3 bent = at.position + p.wobble * fbm3(slow) + (0.3 * p.wobble) * fbm3(slow * 4.3 + vec3(19.1));
  float radius = length(vec2(bent.x - 1.3, bent.z + 0.4)) * p.rings;
  float year = fract(radius + 0.12 * fbm(bent * vec3(6.0, 0.8, 6.0), 8));
  year = clamp(year + 0.1 * fbm(bent * vec3(19.0, 1.7, 19.0) + vec3(43.1), 8), 0.0, 1.0);
  float late = smoothstep(0.35, 0.85, year) * (1.0 - smoothstep(0.93, 1.0, year));

  // Fibres and pores are drawn out along the trunk; pores gather in the spring wood.
  float fibre = 0.5 + fbm(bent * vec3(34.0, 1.1, 34.0), 8);
  Cells vessels = worley(bent * p.pores * vec3(1.0, 0.09, 1.0) + 0.2 * fbm3(bent * vec3(9.0, 1.0, 9.0)));
  float pore = 1.0 - smoothstep(0.12, 0.2, vessels.nearest + 0.1 * late);

  // Varnish is gone in scuffed patches.
  float scuffs = fbm(at.position * 2.2 + 0.35 * fbm3(at.position * 3.7), 8);
  float bare = smoothstep(-0.04, 0.04, scuffs - 0.3 + p.wear);

  Coating wood = Coating(mix(p.early, p.late, clamp(late + 0.25 * (fibre - 0.5), 0.0, 1.0)), vec3(0.05), vec3(0.0));
  wood = mix_coating(wood, Coating(p.pore, vec3(0.02), vec3(0.0)), pore);
  wood.gloss = vec3(0.16 * (1.0 - bare));
  return Pattern(wood);
}

vec3 radiance(Pattern m, vec3 to_light, vec3 to_viewer) { return coating_radiance(m.coating, to_light, to_viewer); }

Material material(Pattern m) { return coating_material(m.coating); }
