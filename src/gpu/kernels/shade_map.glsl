// Samples by the map, about one normal (render/basis_shading.cpp).
vec3 redmap_emission(float redmap_w[REDMAP_BASIS]) {
  vec3 redmap_sum = vec3(0.0);
#ifdef REDMAP_EMITS
  for (uint redmap_b = 0u; redmap_b < uint(REDMAP_BASIS); redmap_b++) {
    redmap_sum += redmap_w[redmap_b] * emission(redmap_patterns[redmap_b]);
    redmap_ended(4u);
  }
#endif
  return redmap_sum;
}

// At the interpolated normal alone.
vec3 redmap_looked_up(RedmapHit redmap_hit_, float redmap_w[REDMAP_BASIS]) {
  vec3 redmap_sum = redmap_emission(redmap_w);
  vec3 redmap_v = redmap_in_frame(redmap_hit_.to_viewer, redmap_hit_.normal, redmap_hit_.tangent);
  for (uint redmap_i = 0u; redmap_i < redmap_picture.z; redmap_i++) {
    vec3 redmap_l;
    vec3 redmap_e = redmap_arriving(redmap_i, redmap_hit_, redmap_l);
    redmap_l = redmap_in_frame(redmap_l, redmap_hit_.normal, redmap_hit_.tangent);
    vec3 redmap_value = vec3(0.0);
    for (uint redmap_b = 0u; redmap_b < uint(REDMAP_BASIS); redmap_b++)
      redmap_value += redmap_w[redmap_b] * redmap_of_basis(redmap_b, redmap_l, redmap_v);
    redmap_sum += redmap_e * redmap_value;
  }
  return redmap_sum;
}

// One basis reflectance for all lights, drawn by its weight: as dear as one, however many there are (paper, section 7).
vec3 redmap_drawn(RedmapHit redmap_hit_, float redmap_w[REDMAP_BASIS], uint redmap_sample) {
  float redmap_total = 0.0;
  for (uint redmap_b = 0u; redmap_b < uint(REDMAP_BASIS); redmap_b++) redmap_total += redmap_w[redmap_b];
  float redmap_wanted = redmap_total * redmap_random(redmap_sample), redmap_below = 0.0;
  uint redmap_chosen = 0u;
  for (uint redmap_b = 0u; redmap_b < uint(REDMAP_BASIS); redmap_b++) {
    if (redmap_w[redmap_b] > 0.0 && redmap_below <= redmap_wanted) redmap_chosen = redmap_b;
    redmap_below += redmap_w[redmap_b];
  }
  vec3 redmap_v = redmap_in_frame(redmap_hit_.to_viewer, redmap_hit_.normal, redmap_hit_.tangent);
  vec3 redmap_sum = vec3(0.0);
  for (uint redmap_i = 0u; redmap_i < redmap_picture.z; redmap_i++) {
    vec3 redmap_l;
    vec3 redmap_e = redmap_arriving(redmap_i, redmap_hit_, redmap_l);
    redmap_l = redmap_in_frame(redmap_l, redmap_hit_.normal, redmap_hit_.tangent);
    redmap_sum += redmap_e * redmap_of_basis(redmap_chosen, redmap_l, redmap_v);
  }
  return redmap_emission(redmap_w) + redmap_total * redmap_sum;
}
