// The weighted sum of the basis reflectances, each asked by itself; mixing_text() (gpu/pattern_mixing.h) asks fewer.
struct RedmapMixed {
  float weights[REDMAP_BASIS];
};
RedmapMixed redmap_mixed(float redmap_w[REDMAP_BASIS]) { return RedmapMixed(redmap_w); }
vec3 redmap_of_mixed(RedmapMixed redmap_m, vec3 redmap_l, vec3 redmap_v) {
  vec3 redmap_sum = vec3(0.0);
  for (uint redmap_b = 0u; redmap_b < uint(REDMAP_BASIS); redmap_b++)
    redmap_sum += redmap_m.weights[redmap_b] * redmap_of_basis(redmap_b, redmap_l, redmap_v);
  return redmap_sum;
}
