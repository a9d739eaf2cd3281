// Every kind of bump under every kind of gloss, one material or two: what `redmap bench normals` measures.
#include "include/bump.glsl"
#include "include/ggx.glsl"
#include "include/phong.glsl"

struct Parameters {
  int kind;        // 0 [0, 4]: 0 fBm, 1 round caps, 2 ridges, 3 bricks, 4 fBm whose one side is dull
  float scale;     // 8 [0.1, 1000] 1/unit: rows of bricks, and largest bumps of fBm, per object unit
  float slope;     // 0.25 [0, 2]: root mean square slope of fBm
  int gloss;       // 0 [0, 1]: 0 Phong, 1 GGX
  float width;     // 100 [0.02, 1000]: exponent of Phong, roughness of GGX
  float diffuse;   // 0.5 [0, 1]: diffuse reflectance of what is glossy; mortar and dull sides have 0.6
  float specular;  // 0.05 [0, 1]: specular reflectance
  int busy;        // 0 [0, 10000]: evaluations of noise that change nothing, to make the shader dear
};

struct Pattern {
  float diffuse;
  float cover;  // part of the glossy material
  float specular;
  float width;
  int gloss;
};

struct Relief {
  vec3 gradient;  // of the height over the surface
  float cover;
};

// Caps of spheres around the points of a lattice, two to a unit of fBm.
Relief caps(vec3 position) {
  vec3 q = 2.0 * position;
  q.x += 0.5 * mod(floor(q.y + 0.5), 2.0);
  vec3 from_centre = q - floor(q + vec3(0.5));
  float radius2 = dot(from_centre, from_centre);
  vec3 gradient = from_centre * (-inversesqrt(max(0.64 - radius2, 0.1)));
  return Relief(mix(gradient, vec3(0.0), bvec3(radius2 > 0.45 * 0.45)), 1.0);
}

// Flanks of one slope, rounded like tanh, two ridges to a unit of fBm.
Relief ridges(vec3 position) {
  float flank = 1.0 - 2.0 / (exp(24.0 * cos(4.0 * pi * position.y)) + 1.0);
  return Relief(vec3(0.0, 0.35 * flank, 0.0) + 0.07 * unit_bumps(2.0 * position, 3), 1.0);
}

// Bricks along x, or z where the surface looks along x: glossy and nearly flat; dull are mortar and slanting edges.
Relief bricks(vec3 position, vec3 normal) {
  bool along_z = abs(normal.x) > abs(normal.z);
  float row = floor(position.y);
  float x = fract(mix(position.x, position.z, along_z) * 0.5 + 0.5 * mod(row, 2.0));
  float y = position.y - row;
  // Distances in 32nds of a row.
  float from_end = 64.0 * min(x, 1.0 - x);
  float from_bed = 32.0 * min(y, 1.0 - y);
  float nearest = min(from_end, from_bed);
  bool is_mortar = nearest < 2.0;
  bool is_face = nearest >= 5.0;
  float rise = mix(mix(0.7, 0.0, is_mortar), 0.0, is_face);
  float uphill_x = mix(0.0, mix(-rise, rise, x < 0.5), from_end < from_bed);
  float uphill_y = mix(mix(-rise, rise, y < 0.5), 0.0, from_end < from_bed);
  vec3 gradient = mix(vec3(uphill_x, uphill_y, 0.0), vec3(0.0, uphill_y, uphill_x), bvec3(along_z));
  float grain = mix(mix(0.21, 0.42, is_mortar), 0.07, is_face);
  return Relief(gradient + grain * unit_bumps(2.0 * position, 3), mix(0.0, 1.0, is_face));
}

// fBm that is glossy only where it rises.
Relief one_sided(vec3 position, vec3 normal, float slope) {
  vec3 gradient = slope * unit_bumps(position, 4);
  float rise = gradient.y - normal.y * dot(normal, gradient);
  return Relief(gradient, smoothstep(-0.06, 0.06, rise));
}

Relief relief(Surface at, Parameters p) {
  vec3 position = at.position * p.scale;
  if (p.kind == 1) return caps(position);
  if (p.kind == 2) return ridges(position);
  if (p.kind == 3) return bricks(position, at.normal);
  if (p.kind == 4) return one_sided(position, at.normal, p.slope);
  return Relief(p.slope * unit_bumps(position, 4), 1.0);
}

vec3 shading_normal(Surface at, Parameters p) { return bumped_normal(at.normal, relief(at, p).gradient); }

Pattern pattern(Surface at, Parameters p) {
  float cover = relief(at, p).cover;
  float unused = 0.0;
  for (int i = 0; i < p.busy; i++) unused += gradient_noise(at.position * p.scale + vec3(float(i)));
  return Pattern(mix(0.6, p.diffuse, cover) + 1e-20 * unused, cover, p.specular, p.width, p.gloss);
}

vec3 radiance(Pattern m, vec3 to_light, vec3 to_viewer) {
  vec3 lobe = vec3(0.0);
  if (m.gloss == 1) {
    lobe = ggx_lobe(vec3(m.specular), m.width, to_light, to_viewer);
  } else {
    lobe = vec3(m.specular * phong_lobe(m.width, to_light, to_viewer));
  }
  return (vec3(m.diffuse * (1.0 / pi)) + m.cover * lobe) * visible_cosine(to_light, to_viewer);
}

Material material(Pattern m) {
  Material exported = ggx_material(vec3(m.diffuse), vec3(m.cover * m.specular), m.width);
  exported.grazing = m.cover;
  if (m.gloss == 1) return exported;
  return phong_material(exported.diffuse, exported.specular, m.width);
}
