// A basis reflectance over a distribution of normals (render/normal_integral.cpp, render/drawn_normals.cpp).

// Directions in the frame of `redmap_n`, its x along the x that they are given in.
vec3 redmap_about(vec3 redmap_n, uint redmap_b, vec3 redmap_l, vec3 redmap_v) {
  float redmap_along = sqrt(max(1.0 - redmap_n.x * redmap_n.x, 1e-12));
  vec3 redmap_x =
      vec3(redmap_along, -redmap_n.x * redmap_n.y / redmap_along, -redmap_n.x * redmap_n.z / redmap_along);
  return redmap_of_basis(redmap_b, redmap_in_frame(redmap_l, redmap_n, redmap_x),
                         redmap_in_frame(redmap_v, redmap_n, redmap_x));
}

// The mean normal of some sums.
vec3 redmap_mean_of(RedmapSums redmap_s) {
  vec2 redmap_xy = redmap_s.mean / max(redmap_s.weight, 1e-12);
  return vec3(redmap_xy, sqrt(max(1.0 - dot(redmap_xy, redmap_xy), 0.01)));
}

// The integral that `redmap_s`, sums by the lobe model, stand for, corrected by the reflectance itself; `redmap_given`: what
// that has at the mean normal, times the weight.
vec3 redmap_modelled(uint redmap_b, RedmapLobes redmap_lobes, RedmapHalf redmap_h, RedmapSums redmap_s,
                     vec3 redmap_given, vec3 redmap_l, vec3 redmap_v) {
  if (redmap_s.weight <= 0.0) return vec3(0.0);
  RedmapValue redmap_whole = redmap_integral(redmap_lobes, redmap_s);
  vec3 redmap_mean = redmap_mean_of(redmap_s);
  RedmapValue redmap_there = redmap_at_normal(redmap_b, redmap_lobes, redmap_h, redmap_mean);
  float redmap_p = redmap_calibrated_part(redmap_s, redmap_whole, redmap_there);
  vec3 redmap_peak = redmap_brightest(redmap_h, redmap_s);
  RedmapValue redmap_bright = redmap_at_normal(redmap_b, redmap_lobes, redmap_h, redmap_peak);
  vec3 redmap_a = redmap_corrected(redmap_whole, redmap_there, redmap_given, redmap_s.weight);
  vec3 redmap_c = redmap_calibrated(redmap_whole, redmap_bright,
                                    redmap_about(redmap_peak, redmap_b, redmap_l, redmap_v));
  return redmap_p <= 0.0 ? redmap_a : redmap_p >= 1.0 ? redmap_c : mix(redmap_a, redmap_c, redmap_p);
}

// At a normal drawn from a distribution, the grain along one of its turns. Turns and normals are paired so that neither
// follows the other.
vec3 redmap_at_drawn(uint redmap_b, RedmapNormals redmap_d, int redmap_i, vec3 redmap_l, vec3 redmap_v) {
  vec3 redmap_n = redmap_drawn_normal(redmap_d, redmap_i);
#if REDMAP_GRAINS
  vec3 redmap_x = redmap_perpendicular(redmap_n, vec3(redmap_turns[redmap_i * 11 % redmap_drawn_normals], 0.0));
#else
  vec3 redmap_x = redmap_perpendicular(redmap_n, vec3(1.0, 0.0, 0.0));
#endif
  return redmap_of_basis(redmap_b, redmap_in_frame(redmap_l, redmap_n, redmap_x),
                         redmap_in_frame(redmap_v, redmap_n, redmap_x));
}
