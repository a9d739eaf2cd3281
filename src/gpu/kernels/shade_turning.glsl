// The surface alone turns: one distribution a sample, around the interpolated normal.
#if REDMAP_GRAINS
vec3 redmap_grained(uint redmap_b, RedmapNormals redmap_d, vec3 redmap_l, vec3 redmap_v) {
  if (redmap_is_narrow(redmap_d)) {
    redmap_d.covariance = vec3(0.0);
    redmap_turns[0] = redmap_turns[redmap_drawn_normals / 2];
    return redmap_at_drawn(redmap_b, redmap_d, 0, redmap_l, redmap_v);
  }
  vec3 redmap_sum = vec3(0.0);
  for (int redmap_i = 0; redmap_i < redmap_drawn_normals; redmap_i++)
    redmap_sum += redmap_at_drawn(redmap_b, redmap_d, redmap_i, redmap_l, redmap_v);
  return redmap_sum / float(redmap_drawn_normals);
}
#endif

vec3 redmap_one_spread(uint redmap_b, RedmapNormals redmap_d, float redmap_w, vec3 redmap_l, vec3 redmap_v) {
  vec3 redmap_mean = redmap_w * redmap_of_basis(redmap_b, redmap_l, redmap_v);
  uint redmap_m = redmap_model(redmap_b);
  float redmap_narrow = redmap_number(redmap_m) * redmap_number(redmap_m);
  float redmap_begin = redmap_spread_begin * redmap_spread_begin * redmap_narrow;
  float redmap_end = redmap_spread_end * redmap_spread_end * redmap_narrow;
  float redmap_variance = redmap_d.covariance.x + redmap_d.covariance.z;
  bool redmap_trusted = redmap_number(redmap_m + 1u) > 0.5;
#if REDMAP_GRAINS
  // A grain has to be drawn wherever it is.
  if (!redmap_trusted) return redmap_w > 0.0 ? redmap_w * redmap_grained(redmap_b, redmap_d, redmap_l, redmap_v) : vec3(0.0);
#endif
  if (redmap_variance <= redmap_begin || redmap_w <= 0.0) return redmap_mean;
  vec3 redmap_value = vec3(0.0);
#ifdef REDMAP_DRAWS_NORMALS
  int redmap_count = redmap_trusted ? 0 : redmap_drawn_normals;
  for (int redmap_i = 0; redmap_i < redmap_count; redmap_i++)
    redmap_value += redmap_at_drawn(redmap_b, redmap_d, redmap_i, redmap_l, redmap_v) *
                    (redmap_w / float(redmap_drawn_normals));
#endif
  if (redmap_trusted) {
    RedmapHalf redmap_h = redmap_half(redmap_l, redmap_v);
    RedmapLobes redmap_lobes = redmap_lobes_at(redmap_b, redmap_h.theta_degrees);
    RedmapSums redmap_s = redmap_no_sums();
    redmap_add(redmap_b, redmap_lobes, redmap_h, redmap_d, redmap_w, redmap_s);
    redmap_value = redmap_modelled(redmap_b, redmap_lobes, redmap_h, redmap_s, redmap_mean, redmap_l, redmap_v);
  }
  return mix(redmap_mean, redmap_value,
             min(1.0, (redmap_variance - redmap_begin) / (redmap_end - redmap_begin)));
}

vec3 redmap_spread_out(RedmapHit redmap_hit_, float redmap_w[REDMAP_BASIS]) {
  vec3 redmap_sum = redmap_constants(redmap_w);
  vec3 redmap_v = redmap_in_frame(redmap_hit_.to_viewer, redmap_hit_.normal, redmap_hit_.tangent);
  RedmapNormals redmap_d = RedmapNormals(vec2(0.0), redmap_curvature(redmap_hit_));
  for (uint redmap_i = 0u; redmap_i < redmap_picture.z; redmap_i++) {
    vec3 redmap_l;
    vec3 redmap_e = redmap_arriving(redmap_i, redmap_hit_, redmap_l);
    redmap_l = redmap_in_frame(redmap_l, redmap_hit_.normal, redmap_hit_.tangent);
    for (uint redmap_b = 0u; redmap_b < uint(REDMAP_BASIS); redmap_b++)
      redmap_sum += redmap_e * redmap_one_spread(redmap_b, redmap_d, redmap_w[redmap_b], redmap_l, redmap_v);
  }
  return redmap_sum;
}

// What of the basis is constant or a cosine, mixed once for all lights: the models' at a middle angle.
const float redmap_middle_angle = 30.0;
struct RedmapSmooth {
  vec3 constant, cosine;
};
RedmapSmooth redmap_smooth_of(uint redmap_b) {
  RedmapLobes redmap_lobes = redmap_lobes_at(redmap_b, redmap_middle_angle);
  return RedmapSmooth(redmap_lobes.constant, redmap_lobes.cosine);
}
vec3 redmap_at_cosine(RedmapSmooth redmap_s, float redmap_c) { return redmap_s.constant + redmap_s.cosine * redmap_c; }

// One basis reflectance a light, drawn by its part of the brightness (paper, section 7, which draws one for all lights by
// weight). Lights of one sample draw from numbers the golden section apart, so that each reflectance comes as often as
// it should. Drawn is only what the smooth part, a control variate, leaves over.
vec3 redmap_drawn(RedmapHit redmap_hit_, float redmap_w[REDMAP_BASIS], uint redmap_sample) {
  float redmap_total = 0.0, redmap_bright[REDMAP_BASIS];
  RedmapSmooth redmap_mixed = RedmapSmooth(vec3(0.0), vec3(0.0));
  for (uint redmap_b = 0u; redmap_b < uint(REDMAP_BASIS); redmap_b++) {
    RedmapSmooth redmap_s = redmap_smooth_of(redmap_b);
    redmap_mixed.constant += redmap_w[redmap_b] * redmap_s.constant;
    redmap_mixed.cosine += redmap_w[redmap_b] * redmap_s.cosine;
    redmap_bright[redmap_b] = redmap_number(redmap_model(redmap_b) + 3u);
    redmap_total += redmap_w[redmap_b] * redmap_bright[redmap_b];
  }
  vec3 redmap_sum = redmap_constants(redmap_w);
  vec3 redmap_v = redmap_in_frame(redmap_hit_.to_viewer, redmap_hit_.normal, redmap_hit_.tangent);
  float redmap_first = redmap_random(redmap_sample);
  for (uint redmap_i = 0u; redmap_i < redmap_picture.z; redmap_i++) {
    float redmap_wanted = redmap_total * fract(redmap_first + 0.61803399 * float(redmap_i)), redmap_below = 0.0;
    uint redmap_chosen = 0u;
    for (uint redmap_b = 0u; redmap_b < uint(REDMAP_BASIS); redmap_b++) {
      if (redmap_w[redmap_b] > 0.0 && redmap_below <= redmap_wanted) redmap_chosen = redmap_b;
      redmap_below += redmap_w[redmap_b] * redmap_bright[redmap_b];
    }
    vec3 redmap_l;
    vec3 redmap_e = redmap_arriving(redmap_i, redmap_hit_, redmap_l);
    redmap_l = redmap_in_frame(redmap_l, redmap_hit_.normal, redmap_hit_.tangent);
    float redmap_c = max(redmap_l.z, 0.0);
    vec3 redmap_left = redmap_of_basis(redmap_chosen, redmap_l, redmap_v) -
                       redmap_at_cosine(redmap_smooth_of(redmap_chosen), redmap_c);
    redmap_sum += redmap_e * (redmap_at_cosine(redmap_mixed, redmap_c) +
                              redmap_left * (redmap_total / redmap_bright[redmap_chosen]));
  }
  return redmap_sum;
}

vec3 redmap_filtered(RedmapHit redmap_hit_, RedmapAxes redmap_a, uint redmap_sample) {
#ifdef REDMAP_MENDS
  float redmap_w[REDMAP_BASIS] = redmap_look_up_over_seams(redmap_hit_, redmap_a);
#else
  float redmap_w[REDMAP_BASIS] = redmap_look_up(redmap_hit_.uv, redmap_a);
#endif
#if REDMAP_LEAVES > 0
  redmap_blend_clusters(redmap_hit_, redmap_a, redmap_w);
#endif
#if REDMAP_GRAINS
  redmap_gather_turns(redmap_hit_, redmap_a);
  return redmap_spread_out(redmap_hit_, redmap_w);
#endif
#ifdef REDMAP_MIXES_ALL
  if (redmap_draws != 0u) return redmap_looked_up(redmap_hit_, redmap_w);  // asks one anyway
#else
  if (redmap_draws != 0u) return redmap_drawn(redmap_hit_, redmap_w, redmap_sample);
#endif
  if (redmap_stage == redmap_spread_stage) return redmap_spread_out(redmap_hit_, redmap_w);
  return redmap_looked_up(redmap_hit_, redmap_w);
}
