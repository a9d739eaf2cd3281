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

// What is asked of the distributions under a footprint: sums by the lobe model of one basis reflectance, or its
// radiance at normals drawn from them.
struct RedmapQuestion {
  uint basis;
  bool turned;
  vec3 turn;
  RedmapHalf about;
  RedmapLobes lobes;
  bool draws;
  vec3 to_light, to_viewer;
  float total, below;  // of the weights: of all, of those already visited
  int next;
  vec3 drawn;
};

// Distributions are drawn in their order, each as often as its weight asks for; neighbours take points far from each
// other (render/drawn_normals.cpp).
void redmap_draw(RedmapNormals redmap_d, float redmap_w, inout RedmapQuestion redmap_q) {
  redmap_q.below += redmap_w;
  float redmap_step = redmap_q.total / float(redmap_drawn_normals);
  while (redmap_q.next < redmap_drawn_normals && redmap_q.below >= redmap_step * (float(redmap_q.next) + 0.5)) {
    redmap_q.drawn += redmap_step * redmap_at_drawn(redmap_q.basis, redmap_d, redmap_q.next * 13 % redmap_drawn_normals,
                                                    redmap_q.to_light, redmap_q.to_viewer);
    redmap_q.next++;
  }
}

void redmap_ask(RedmapNormals redmap_d, float redmap_w, inout RedmapQuestion redmap_q, inout RedmapSums redmap_s) {
#ifdef REDMAP_DRAWS_NORMALS
  if (redmap_q.draws) {
    redmap_draw(redmap_d, redmap_w, redmap_q);
    return;
  }
#endif
  redmap_add(redmap_q.basis, redmap_q.lobes, redmap_q.about, redmap_d, redmap_w, redmap_s);
}

void redmap_ask_patch(RedmapPatch redmap_p, float redmap_part_, inout RedmapQuestion redmap_q,
                      inout RedmapSums redmap_s) {
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
        RedmapNormals redmap_d = redmap_seen_normals(
            redmap_cut(redmap_unpack(redmap_at), redmap_p, ivec2(redmap_x, redmap_y), redmap_column), redmap_q.turned,
            redmap_q.turn);
        redmap_ask(redmap_d, redmap_scale * redmap_w * redmap_own, redmap_q, redmap_s);
        redmap_at += 7u + uint(REDMAP_BASIS);
      }
    }
}

// All distributions under a footprint; `redmap_w`: what the weights have where nothing is covered.
RedmapSums redmap_ask_all(RedmapGather redmap_g, float redmap_w, inout RedmapQuestion redmap_q) {
  RedmapSums redmap_s = redmap_no_sums();
  redmap_ask_patch(redmap_g.fine, redmap_g.part.x, redmap_q, redmap_s);
  redmap_ask_patch(redmap_g.coarse, redmap_g.part.y, redmap_q, redmap_s);
  if (redmap_g.part.x + redmap_g.part.y <= 0.0)
    redmap_ask(RedmapNormals(vec2(0.0), redmap_q.turn), redmap_w, redmap_q, redmap_s);
  return redmap_s;
}

vec3 redmap_over_normals(RedmapGather redmap_g, float redmap_w, inout RedmapQuestion redmap_q) {
  redmap_q.draws = false;
  redmap_q.lobes = redmap_lobes_at(redmap_q.basis, redmap_q.about.theta_degrees);
  RedmapSums redmap_s = redmap_ask_all(redmap_g, redmap_w, redmap_q);
#ifdef REDMAP_DRAWS_NORMALS
  if (redmap_number(redmap_model(redmap_q.basis) + 1u) < 0.5) {
    redmap_q.draws = true;
    redmap_q.total = redmap_s.weight;
    redmap_q.below = 0.0;
    redmap_q.next = redmap_s.weight > 0.0 ? 0 : redmap_drawn_normals;
    redmap_q.drawn = vec3(0.0);
    redmap_ask_all(redmap_g, redmap_w, redmap_q);
    return redmap_q.drawn;
  }
#endif
  vec3 redmap_mean =
      redmap_s.weight * redmap_about(redmap_mean_of(redmap_s), redmap_q.basis, redmap_q.to_light, redmap_q.to_viewer);
  return redmap_modelled(redmap_q.basis, redmap_q.lobes, redmap_q.about, redmap_s, redmap_mean, redmap_q.to_light,
                         redmap_q.to_viewer);
}

vec3 redmap_filtered(RedmapHit redmap_hit_, RedmapAxes redmap_a, uint redmap_sample) {
  float redmap_w[REDMAP_BASIS] = redmap_look_up(redmap_hit_.uv, redmap_a);
  RedmapGather redmap_g = redmap_gather(redmap_hit_, redmap_a);
#if REDMAP_GRAINS
  redmap_gather_turns(redmap_hit_, redmap_a);
#endif
  vec3 redmap_sum = redmap_constants(redmap_w);
  RedmapQuestion redmap_q;
  redmap_q.turned = redmap_hit_.turned;
  redmap_q.turn = redmap_curvature(redmap_hit_);
  redmap_q.to_viewer = redmap_in_frame(redmap_hit_.to_viewer, redmap_hit_.normal, redmap_hit_.tangent);
  for (uint redmap_i = 0u; redmap_i < redmap_picture.z; redmap_i++) {
    vec3 redmap_l;
    vec3 redmap_e = redmap_arriving(redmap_i, redmap_hit_, redmap_l);
    redmap_q.to_light = redmap_in_frame(redmap_l, redmap_hit_.normal, redmap_hit_.tangent);
    redmap_q.about = redmap_half(redmap_q.to_light, redmap_q.to_viewer);
    for (uint redmap_b = 0u; redmap_b < uint(REDMAP_BASIS); redmap_b++) {
      redmap_q.basis = redmap_b;
      redmap_sum += redmap_e * redmap_over_normals(redmap_g, redmap_w[redmap_b], redmap_q);
    }
  }
  return redmap_sum;
}
