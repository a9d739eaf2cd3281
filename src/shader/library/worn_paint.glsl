// Production cost: glossy paint on primed steel, chipped down to primer and metal, with rust creeping from the chips.
#include "include/two_lobes.glsl"
#include "include/worley.glsl"

struct Parameters {
  float scale;  // 1.6 [0.01, 100] 1/unit: size of everything, in worn patches per object unit
  float wear;   // 0.25 [-2, 2]: how much paint is gone, more for larger values
  float rust;   // 0.1 [-2, 2]: how much of the bare steel rusts, more for larger values
  vec3 paint;   // 0.05 0.2 0.32 [0, 1]: diffuse colour of the paint
  vec3 primer;  // 0.5 0.47 0.42 [0, 1]: diffuse colour of the primer
  vec3 orange;  // 0.36 0.13 0.04 [0, 1]: diffuse colour of the rust
};

struct Pattern {
  Coating coating;
};

vec3 fbm3(vec3 p) { return vec3(fbm(p, 8), fbm(p + vec3(31.7), 8), fbm(p + vec3(67.1), 8)); }

Pattern pattern(Surface at, Parameters p) {
  // Wear: patches with ragged borders, and chips where flakes of paint have come off whole.
  vec3 q = at.position * p.scale;
  vec3 ragged = q + 0.3 * fbm3(q * 2.1);
  float patches = fbm(ragged, 8);
  Cells flakes = worley(q * 6.5 + 0.4 * fbm3(q * 9.7));
  float chips = 0.5 * (flakes.id - 0.5) * smoothstep(0.0, 0.15, flakes.second - flakes.nearest);
  float depth = patches + chips + p.wear;
  float primer = smoothstep(0.3, 0.32, depth);
  float metal = smoothstep(0.42, 0.45, depth);

  // Scratches follow the zeros of drawn-out noise, where something has rubbed along the paint.
  float rubbed = smoothstep(0.1, 0.4, fbm(q * 1.3 + vec3(7.7), 8));
  float across = abs(fbm(q * vec3(2.0, 9.0, 2.0) + 0.1 * ragged, 8));
  float scratch = rubbed * (1.0 - smoothstep(0.012, 0.02, across));
  metal = max(metal, scratch);

  // Rust starts on bare metal and runs down from it; pits in it are Worley cells of folded space.
  vec3 run = vec3(ragged.x, 0.25 * ragged.y, ragged.z);
  Cells pits = worley(ragged * 14.0);
  float creeping = fbm(run * 3.3 + 0.4 * fbm3(q * 4.9 + vec3(53.9)), 8) + 0.25 * (0.5 - pits.nearest);
  float rust = smoothstep(-0.02, 0.08, creeping - 0.1 + p.rust) * smoothstep(0.3, 0.5, depth + 0.12 * creeping);

  // Dirt dulls the paint.
  float dirt = smoothstep(-0.1, 0.7, fbm(q * 3.1 + 0.5 * ragged + vec3(97.3), 8) + 0.3 * fbm(run * 9.1, 8));
  Coating coat = Coating(p.paint, vec3(0.02), vec3(0.14));
  coat = mix_coating(coat, Coating(0.5 * p.paint + vec3(0.05), vec3(0.06), vec3(0.0)), dirt);
  coat = mix_coating(coat, Coating(p.primer, vec3(0.03), vec3(0.0)), primer);
  coat = mix_coating(coat, Coating(vec3(0.04), vec3(0.2), vec3(0.4)), metal);
  return Pattern(mix_coating(coat, Coating(p.orange, vec3(0.01), vec3(0.0)), rust));
}

vec3 radiance(Pattern m, vec3 to_light, vec3 to_viewer) { return coating_radiance(m.coating, to_light, to_viewer); }

Material material(Pattern m) { return coating_material(m.coating); }
