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

// Directions in the frame of the normal at `redmap_xy` of theirs, its x along theirs.
vec3 redmap_turned(vec2 redmap_xy, vec3 redmap_v) {
  vec3 redmap_n = vec3(redmap_xy, sqrt(max(1.0 - dot(redmap_xy, redmap_xy), 0.01)));
  float redmap_along = sqrt(1.0 - redmap_n.x * redmap_n.x);
  float redmap_x = dot(redmap_v.yz, redmap_n.yz) / redmap_along;
  return vec3(redmap_along * redmap_v.x - redmap_n.x * redmap_x,
              (redmap_n.z * redmap_v.y - redmap_n.y * redmap_v.z) / redmap_along, dot(redmap_v, redmap_n));
}

// Over the footprint's normals by the product of two Gauss-Legendre rules of as many points as their spread needs; of one
// where they turn too little to be seen. Points move apart little by little, so that nothing pops.
struct RedmapRule {
  vec2 along_x, along_y;  // from the middle to the outermost points
  uint points;            // each way
};
RedmapRule redmap_rule(RedmapHit redmap_hit_) {
#ifdef REDMAP_DRAWS_NORMALS
  return RedmapRule(vec2(0.0), vec2(0.0), 1u);
#else
#ifdef REDMAP_FAST
  const float redmap_few = redmap_few_normals_fast;
#else
  const float redmap_few = redmap_few_normals;
#endif
  float redmap_narrow = redmap_map.w / (redmap_few * redmap_few);  // of the narrowest highlight, squared
  float redmap_begin = redmap_spread_begin * redmap_spread_begin * redmap_narrow;
  float redmap_end = redmap_spread_end * redmap_spread_end * redmap_narrow;
  vec4 redmap_t = redmap_turning(redmap_hit_);
  float redmap_variance = dot(redmap_t, redmap_t) / 12.0;
  float redmap_p = clamp((redmap_variance - redmap_begin) / (redmap_end - redmap_begin), 0.0, 1.0);
  uint redmap_n = redmap_p <= 0.0 ? 1u : redmap_variance < redmap_two_normals * redmap_two_normals * redmap_narrow ? 2u : 3u;
  redmap_t *= 0.5 * sqrt(redmap_p) * (redmap_n == 2u ? 0.57735027 : 1.0);
  return RedmapRule(redmap_t.xy, redmap_t.zw, redmap_n);
#endif
}
// A point from -1 to 1, and its weight.
vec2 redmap_point_of(uint redmap_i, uint redmap_n) {
  if (redmap_n == 3u) return vec2(float(redmap_i) - 1.0, redmap_i == 1u ? 4.0 / 6.0 : 1.0 / 6.0);
  return redmap_n == 2u ? vec2(2.0 * float(redmap_i) - 1.0, 0.5) : vec2(0.0, 1.0);
}

vec3 redmap_looked_up(RedmapHit redmap_hit_, float redmap_w[REDMAP_BASIS]) {
  RedmapRule redmap_r = redmap_rule(redmap_hit_);
  vec3 redmap_sum = redmap_constants(redmap_w);
  RedmapMixed redmap_m = redmap_mixed(redmap_w);
  vec3 redmap_v = redmap_in_frame(redmap_hit_.to_viewer, redmap_hit_.normal, redmap_hit_.tangent);
  for (uint redmap_i = 0u; redmap_i < redmap_picture.z; redmap_i++) {
    vec3 redmap_l;
    vec3 redmap_e = redmap_arriving(redmap_i, redmap_hit_, redmap_l);
    redmap_l = redmap_in_frame(redmap_l, redmap_hit_.normal, redmap_hit_.tangent);
    vec3 redmap_value = vec3(0.0);
    for (uint redmap_k = 0u; redmap_k < redmap_r.points * redmap_r.points; redmap_k++) {
      vec2 redmap_x = redmap_point_of(redmap_k % redmap_r.points, redmap_r.points);
      vec2 redmap_y = redmap_point_of(redmap_k / redmap_r.points, redmap_r.points);
      vec2 redmap_xy = redmap_r.along_x * redmap_x.x + redmap_r.along_y * redmap_y.x;
      redmap_value += redmap_x.y * redmap_y.y *
                      redmap_of_mixed(redmap_m, redmap_turned(redmap_xy, redmap_l), redmap_turned(redmap_xy, redmap_v));
    }
    redmap_sum += redmap_e * redmap_value;
  }
  return redmap_sum;
}
