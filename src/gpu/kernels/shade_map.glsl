// Samples by the map, about one normal (render/basis_shading.cpp).
#ifdef REDMAP_LAYERS
vec3 redmap_behind_of(float redmap_w[REDMAP_BASIS]) {
  vec3 redmap_sum = vec3(0.0);
#ifdef REDMAP_TRANSMITS
  for (uint redmap_b = 0u; redmap_b < uint(REDMAP_BASIS); redmap_b++) {
    redmap_sum += redmap_w[redmap_b] * transmittance(redmap_patterns[redmap_b]);
    redmap_ended(3u);
  }
#endif
  return redmap_sum;
}
#endif

// What does not depend on directions: returns the emission.
vec3 redmap_constants(float redmap_w[REDMAP_BASIS]) {
#ifdef REDMAP_LAYERS
  redmap_passing = redmap_behind_of(redmap_w);
#endif
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
  vec3 redmap_sum = redmap_constants(redmap_w);
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
