// The samples of one object: its shader at places of the basis, and itself.
vec3 redmap_of_basis(uint redmap_b, vec3 redmap_l, vec3 redmap_v) {
#ifdef REDMAP_HIDES_FRAMES
  redmap_l = redmap_unhidden(redmap_b, redmap_l);
  redmap_v = redmap_unhidden(redmap_b, redmap_v);
#endif
#ifdef REDMAP_BLACK_BOX
  RedmapPlace redmap_m = redmap_patterns[redmap_b];
  vec3 redmap_value = radiance(redmap_m.at, redmap_parameters, redmap_to_object(redmap_m, redmap_l),
                               redmap_to_object(redmap_m, redmap_v));
#else
  vec3 redmap_value = radiance(redmap_patterns[redmap_b], redmap_l, redmap_v);
#endif
  redmap_ended(2u);
  return redmap_value;
}

// The shader itself at a hit.
vec3 redmap_original(RedmapHit redmap_hit_) {
  Surface redmap_at = redmap_hit_place(redmap_hit_);
  vec3 redmap_n = redmap_hit_.normal, redmap_t = redmap_hit_.tangent;
#ifdef REDMAP_PERTURBS
  redmap_n = redmap_posed(redmap_hit_, shading_normal(redmap_at, redmap_parameters));
  redmap_ended(1u);
#endif
#ifdef REDMAP_TURNS
  redmap_t = redmap_posed(redmap_hit_, normalize(shading_tangent(redmap_at, redmap_parameters)));
  redmap_ended(6u);
#endif
#if defined(REDMAP_PERTURBS) || defined(REDMAP_TURNS)
  redmap_t = redmap_perpendicular(redmap_n, redmap_t);
#endif
  vec3 redmap_sum = vec3(0.0);
#ifndef REDMAP_BLACK_BOX
  Pattern redmap_m = pattern(redmap_at, redmap_parameters);
  redmap_ended(0u);
#if defined(REDMAP_LAYERS) && defined(REDMAP_TRANSMITS)
  redmap_passing = transmittance(redmap_m);
  redmap_ended(3u);
#endif
#ifdef REDMAP_EMITS
  redmap_sum = emission(redmap_m);
  redmap_ended(4u);
#endif
#endif
  for (uint redmap_i = 0u; redmap_i < redmap_picture.z; redmap_i++) {
    vec3 redmap_l;
    vec3 redmap_e = redmap_arriving(redmap_i, redmap_hit_, redmap_l);
#ifdef REDMAP_BLACK_BOX
    redmap_sum += redmap_e * radiance(redmap_at, redmap_parameters, redmap_at_rest(redmap_hit_, redmap_l),
                                      redmap_at_rest(redmap_hit_, redmap_hit_.to_viewer));
#else
    redmap_sum += redmap_e * radiance(redmap_m, redmap_in_frame(redmap_l, redmap_n, redmap_t),
                                      redmap_in_frame(redmap_hit_.to_viewer, redmap_n, redmap_t));
#endif
    redmap_ended(2u);
  }
  return redmap_sum;
}
