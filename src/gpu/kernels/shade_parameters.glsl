// Samples by averaged material parameters and slopes of normals: render/parameters_shading.cpp, map/slope_moments.cpp
// and shader/material_channels.cpp, one at a time.
const float redmap_weight_floor = 1e-9, redmap_largest_exponent = 1e6;
// Tokuyoshi and Kaplanyan 2019: the variance of the normals that the kernel adds ends at half of .18.
const float redmap_largest_kernel = 0.09;

Material redmap_material(float redmap_c[REDMAP_CHANNELS]) {
  float redmap_ggx = redmap_c[10], redmap_phong = redmap_c[9] - redmap_ggx;
  float redmap_variance = redmap_c[11] / max(redmap_phong, redmap_weight_floor);
  return Material(vec3(redmap_c[0], redmap_c[1], redmap_c[2]), vec3(redmap_c[3], redmap_c[4], redmap_c[5]),
                  vec3(redmap_c[6], redmap_c[7], redmap_c[8]),
                  clamp(1.0 / max(redmap_variance, redmap_weight_floor) - 2.0, 0.0, redmap_largest_exponent),
                  redmap_ggx / max(redmap_c[9], redmap_weight_floor), redmap_c[15],
                  vec3(redmap_c[12], redmap_c[13], redmap_c[14]) / max(redmap_ggx, redmap_weight_floor));
}

// A frame about the mean normal and the covariance of normals over its x and y.
struct RedmapMean {
  vec3 x, y, z, covariance;
};
float redmap_between(vec3 redmap_a, vec3 redmap_b, vec3 redmap_s) {
  return redmap_a.x * redmap_b.x * redmap_s.x + (redmap_a.x * redmap_b.y + redmap_a.y * redmap_b.x) * redmap_s.y +
         redmap_a.y * redmap_b.y * redmap_s.z;
}
RedmapMean redmap_mean_of(RedmapHit redmap_hit_, float redmap_c[REDMAP_CHANNELS]) {
  vec3 redmap_x = redmap_hit_.tangent, redmap_z = redmap_hit_.normal, redmap_y = cross(redmap_z, redmap_x);
  RedmapMean redmap_m = RedmapMean(redmap_x, redmap_y, redmap_z, vec3(0.0));
#if REDMAP_SLOPES > 0
  vec2 redmap_slope = vec2(redmap_c[REDMAP_SLOPES], redmap_c[REDMAP_SLOPES + 1]);
  vec3 redmap_s = vec3(max(redmap_c[REDMAP_SLOPES + 2] - redmap_slope.x * redmap_slope.x, 0.0),
                       redmap_c[REDMAP_SLOPES + 3] - redmap_slope.x * redmap_slope.y,
                       max(redmap_c[REDMAP_SLOPES + 4] - redmap_slope.y * redmap_slope.y, 0.0));
  float redmap_most = sqrt(redmap_s.x * redmap_s.z);
  redmap_s.y = clamp(redmap_s.y, -redmap_most, redmap_most);
  // Seen from behind, the frame's y looks the other way.
  float redmap_side = redmap_hit_.turned ? -1.0 : 1.0;
  redmap_slope.y *= redmap_side, redmap_s.y *= redmap_side;
  vec3 redmap_n = normalize(vec3(redmap_slope, 1.0));
  vec3 redmap_t = normalize(vec3(1.0, 0.0, 0.0) - redmap_n * redmap_n.x), redmap_b = cross(redmap_n, redmap_t);
  redmap_m.x = redmap_x * redmap_t.x + redmap_y * redmap_t.y + redmap_z * redmap_t.z;
  redmap_m.y = redmap_x * redmap_b.x + redmap_y * redmap_b.y + redmap_z * redmap_b.z;
  redmap_m.z = redmap_x * redmap_n.x + redmap_y * redmap_n.y + redmap_z * redmap_n.z;
  redmap_m.covariance = redmap_n.z * redmap_n.z *
                        vec3(redmap_between(redmap_t, redmap_t, redmap_s), redmap_between(redmap_t, redmap_b, redmap_s),
                             redmap_between(redmap_b, redmap_b, redmap_s));
#endif
  return redmap_m;
}

vec3 redmap_kernel_covariance(RedmapHit redmap_hit_, vec3 redmap_x, vec3 redmap_y) {
  vec3 redmap_dx = redmap_hit_.dn_du * redmap_hit_.duv_dx.x + redmap_hit_.dn_dv * redmap_hit_.duv_dx.y;
  vec3 redmap_dy = redmap_hit_.dn_du * redmap_hit_.duv_dy.x + redmap_hit_.dn_dv * redmap_hit_.duv_dy.y;
  vec2 redmap_a = vec2(dot(redmap_x, redmap_dx), dot(redmap_x, redmap_dy));
  vec2 redmap_b = vec2(dot(redmap_y, redmap_dx), dot(redmap_y, redmap_dy));
  vec3 redmap_c = vec3(dot(redmap_a, redmap_a), dot(redmap_a, redmap_b), dot(redmap_b, redmap_b)) / 12.0;
  return redmap_c * min(1.0, redmap_largest_kernel / max(redmap_c.x + redmap_c.z, 1e-9));
}

vec3 redmap_behind_of(float redmap_c[REDMAP_CHANNELS]) { return vec3(redmap_c[6], redmap_c[7], redmap_c[8]); }

vec3 redmap_filtered(RedmapHit redmap_hit_, RedmapAxes redmap_a, uint redmap_sample) {
  float redmap_c[REDMAP_CHANNELS] = redmap_look_up(redmap_hit_.uv, redmap_a);
#ifdef REDMAP_LAYERS
  redmap_passing = redmap_behind_of(redmap_c);
#endif
  Material redmap_m = redmap_material(redmap_c);
  RedmapMean redmap_f = redmap_mean_of(redmap_hit_, redmap_c);
  vec3 redmap_spread = redmap_f.covariance + redmap_kernel_covariance(redmap_hit_, redmap_f.x, redmap_f.y);
  vec3 redmap_v = redmap_in_frame(redmap_hit_.to_viewer, redmap_f.z, redmap_f.x);
  vec3 redmap_sum = vec3(0.0);
  for (uint redmap_i = 0u; redmap_i < redmap_picture.z; redmap_i++) {
    vec3 redmap_l;
    vec3 redmap_e = redmap_arriving(redmap_i, redmap_hit_, redmap_l);
    redmap_sum += redmap_e * widened_radiance(redmap_m, redmap_spread, redmap_in_frame(redmap_l, redmap_f.z, redmap_f.x),
                                              redmap_v);
  }
  return redmap_sum;
}
