// Production cost: folded sandstone with iron bands and shale, cut by quartz veins, with lichen on top.
#include "include/two_lobes.glsl"
#include "include/worley.glsl"

struct Parameters {
  float scale;     // 1 [0.01, 100] 1/unit: size of everything, in folds per object unit
  float beds;      // 7 [0.1, 100]: beds per fold
  float folding;   // 0.22 [0, 4]: how far the beds are folded
  float veins;     // 0.035 [0, 1]: width of the quartz veins
  float lichen;    // 0.08 [-2, 2]: how much lichen there is, more for larger values
  vec3 sandstone;  // 0.62 0.48 0.32 [0, 1]: diffuse colour of the pale beds
  vec3 iron;       // 0.4 0.14 0.07 [0, 1]: diffuse colour of the red bands
  vec3 shale;      // 0.09 0.1 0.12 [0, 1]: diffuse colour of the dark, shiny beds
  vec3 green;      // 0.42 0.5 0.22 [0, 1]: diffuse colour of the lichen
};

struct Pattern {
  Coating coating;
};

vec3 fbm3(vec3 p) { return vec3(fbm(p, 8), fbm(p + vec3(31.7), 8), fbm(p + vec3(67.1), 8)); }

Pattern pattern(Surface at, Parameters p) {
  // Fold space twice: large folds, and small ones in what is already folded.
  vec3 q = at.position * p.scale;
  vec3 folded = q + p.folding * fbm3(q * 1.3);
  folded = folded + (0.25 * p.folding) * fbm3(folded * 2.9 + vec3(11.3));

  // Beds follow the folded height; their kind is noise that hardly changes along them.
  float height = p.beds * folded.y + 0.5 * fbm(folded * 3.1, 8);
  vec3 along = vec3(0.15 * folded.x, height, 0.15 * folded.z);
  float specks = max(fbm(folded * 9.0 + vec3(23.9), 8), fbm(q * 13.0 + vec3(59.3), 8) - 0.1);
  float iron = smoothstep(0.05, 0.3, fbm(along * 0.8, 8) + 0.35 * specks);
  float shale = smoothstep(0.12, 0.2, fbm(along * 0.55 + vec3(41.9), 8));

  // Veins run between the cells of broken rock, lichen grows in rosettes where it is damp.
  Cells blocks = worley(folded * 2.3 + vec3(5.7));
  float vein = 1.0 - smoothstep(p.veins, 1.5 * p.veins, blocks.second - blocks.nearest);
  Cells rosettes = worley(q * 5.0 + 0.3 * fbm3(q * 6.1));
  float damp = fbm(q * 1.7 + vec3(73.3), 8) + 0.6 - rosettes.nearest;
  damp += 0.3 * fbm(q * 8.3 + vec3(87.7), 8);
  float lichen = smoothstep(0.45 - p.lichen, 0.6 - p.lichen, damp);

  Coating rock = Coating(p.sandstone, vec3(0.03), vec3(0.0));
  rock = mix_coating(rock, Coating(p.iron, vec3(0.06), vec3(0.01)), iron);
  rock = mix_coating(rock, Coating(p.shale, vec3(0.1), vec3(0.08)), shale);
  rock = mix_coating(rock, Coating(vec3(0.7), vec3(0.05), vec3(0.25)), vein);
  return Pattern(mix_coating(rock, Coating(p.green, vec3(0.0), vec3(0.0)), lichen));
}

vec3 radiance(Pattern m, vec3 to_light, vec3 to_viewer) { return coating_radiance(m.coating, to_light, to_viewer); }

Material material(Pattern m) { return coating_material(m.coating); }
