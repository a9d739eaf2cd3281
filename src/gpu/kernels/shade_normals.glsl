// The shader perturbs normals: mixtures of distributions under the footprint, each with its own weights.

// Distribution with the surface's own turning, seen from the side that the hit is.
RedmapNormals redmap_seen_normals(RedmapNormals redmap_d, bool redmap_turned, vec3 redmap_turn) {
  // Frames of hits from behind have their y and z turned around.
  if (redmap_turned) {
    redmap_d.mean.y = -redmap_d.mean.y;
    redmap_d.covariance.y = -redmap_d.covariance.y;
  }
  redmap_d.covariance += redmap_turn;
  return redmap_d;
}

// What is asked of the distributions under a footprint: sums by the lobe model of one basis reflectance.
struct RedmapQuestion {
  uint basis;
  bool turned;
  vec3 turn;
  RedmapHalf about;
  RedmapLobes lobes;
};
void redmap_add_patch(RedmapPatch redmap_p, float redmap_part_, RedmapQuestion redmap_q, inout RedmapSums redmap_s) {
  if (redmap_part_ <= 0.0) return;
  uint redmap_b = redmap_q.basis;
  float redmap_scale = redmap_part_ * redmap_scales[redmap_b / 4u][redmap_b % 4u];
  uint redmap_count = redmap_p.level == 0u ? 1u : 2u;
  for (int redmap_y = redmap_p.from.y; redmap_y <= redmap_p.to.y; redmap_y++)
    for (int redmap_x = redmap_p.from.x; redmap_x <= redmap_p.to.x; redmap_x++) {
      int redmap_column;
      RedmapTexel redmap_t;
      float redmap_w = redmap_area(redmap_p, ivec2(redmap_x, redmap_y), redmap_column, redmap_t);
      if (redmap_w <= 0.0) continue;
      uint redmap_at = redmap_normals_at(redmap_p, redmap_column, redmap_y);
      for (uint redmap_g = 0u; redmap_g < redmap_count; redmap_g++) {
        float redmap_own = redmap_p.level == 0u ? redmap_t.channels[redmap_b / 4u][redmap_b % 4u]
                                                : redmap_coverage(redmap_t) * float(redmap_byte(redmap_at + 6u)) *
                                                      float(redmap_byte(redmap_at + 7u + redmap_b)) / 65025.0;
        RedmapNormals redmap_d = redmap_seen_normals(redmap_unpack(redmap_at), redmap_q.turned, redmap_q.turn);
        redmap_add(redmap_b, redmap_q.lobes, redmap_q.about, redmap_d, redmap_scale * redmap_w * redmap_own, redmap_s);
        redmap_at += 7u + REDMAP_BASIS;
      }
    }
}

vec3 redmap_filtered(RedmapHit redmap_hit_, RedmapAxes redmap_a, uint redmap_sample) {
  float redmap_w[REDMAP_BASIS] = redmap_look_up(redmap_hit_.uv, redmap_a);
  RedmapGather redmap_g = redmap_gather(redmap_hit_, redmap_a);
  vec3 redmap_sum = redmap_emission(redmap_w);
  vec3 redmap_v = redmap_in_frame(redmap_hit_.to_viewer, redmap_hit_.normal, redmap_hit_.tangent);
  RedmapQuestion redmap_q;
  redmap_q.turned = redmap_hit_.turned;
  redmap_q.turn = redmap_curvature(redmap_hit_);
  for (uint redmap_i = 0u; redmap_i < redmap_picture.z; redmap_i++) {
    vec3 redmap_l;
    vec3 redmap_e = redmap_arriving(redmap_i, redmap_hit_, redmap_l);
    redmap_l = redmap_in_frame(redmap_l, redmap_hit_.normal, redmap_hit_.tangent);
    redmap_q.about = redmap_half(redmap_l, redmap_v);
    for (uint redmap_b = 0u; redmap_b < REDMAP_BASIS; redmap_b++) {
      redmap_q.basis = redmap_b;
      redmap_q.lobes = redmap_lobes_at(redmap_b, redmap_q.about.theta_degrees);
      RedmapSums redmap_s = redmap_no_sums();
      redmap_add_patch(redmap_g.fine, redmap_g.part.x, redmap_q, redmap_s);
      redmap_add_patch(redmap_g.coarse, redmap_g.part.y, redmap_q, redmap_s);
      // Between charts, or nowhere: what the weights have there, at one normal.
      if (redmap_g.part.x + redmap_g.part.y <= 0.0)
        redmap_add(redmap_b, redmap_q.lobes, redmap_q.about, RedmapNormals(vec2(0.0), redmap_q.turn),
                   redmap_w[redmap_b], redmap_s);
      redmap_sum += redmap_e * redmap_modelled(redmap_b, redmap_q.lobes, redmap_q.about, redmap_s, redmap_l, redmap_v);
    }
  }
  return redmap_sum;
}
