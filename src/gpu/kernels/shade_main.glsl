// One sample an invocation.

// What the sample gets of one of the lists that it is in: the second adds to what the first left. In layers all of it
// adds to what was seen in front.
void redmap_keep(uint redmap_sample, vec3 redmap_value, float redmap_share, bool redmap_adds) {
  redmap_value *= redmap_share;
#ifdef REDMAP_LAYERS
  uint redmap_b = redmap_path(redmap_behind, redmap_sample);
  vec3 redmap_behind_it = redmap_passing * redmap_share;
  redmap_paths[redmap_b].xyz = redmap_adds ? redmap_paths[redmap_b].xyz + redmap_behind_it : redmap_behind_it;
  redmap_value *= redmap_paths[redmap_path(redmap_through, redmap_sample)].xyz;
  redmap_adds = true;
#endif
  uint redmap_i = 3u * redmap_sample;
  if (redmap_adds)
    redmap_value +=
        vec3(redmap_radiance[redmap_i], redmap_radiance[redmap_i + 1u], redmap_radiance[redmap_i + 2u]);
  redmap_radiance[redmap_i] = redmap_value.x;
  redmap_radiance[redmap_i + 1u] = redmap_value.y;
  redmap_radiance[redmap_i + 2u] = redmap_value.z;
}

void main() {
  uint redmap_i = gl_GlobalInvocationID.x;
#ifdef REDMAP_GUARDED
  if (!redmap_goes_on()) return;
#endif
#ifdef REDMAP_PASSES
  if (redmap_stage == redmap_pass_stage) {
    redmap_pass_light(redmap_i);
    return;
  }
#endif
  uint redmap_list = redmap_stage - redmap_near_stage;
  if (redmap_i >= redmap_groups[redmap_list].w) return;
  uint redmap_entry = redmap_listed(redmap_list, redmap_i), redmap_sample = redmap_entry & ~redmap_in_both;
  uvec2 redmap_at = redmap_place_of(redmap_sample);
  RedmapHit redmap_hit_ = redmap_hit(texelFetch(redmap_seen, ivec3(redmap_at, 0), 0).x - redmap_numbers.x, redmap_at);
#ifdef REDMAP_LAYERS
  redmap_here = redmap_sample;
#endif
  if (redmap_stage == redmap_near_stage) {
    vec3 redmap_value = redmap_original(redmap_hit_);
    float redmap_share = 1.0;
#if REDMAP_CHANNELS > 0
    if (redmap_filters != 0u)
      redmap_share = 1.0 - redmap_part(redmap_axes(redmap_hit_.duv_dx, redmap_hit_.duv_dy));
#endif
    redmap_keep(redmap_sample, redmap_value, redmap_share, false);
  }
#if REDMAP_CHANNELS > 0
  if (redmap_stage != redmap_near_stage) {
    RedmapAxes redmap_a = redmap_axes(redmap_hit_.duv_dx, redmap_hit_.duv_dy);
    redmap_keep(redmap_sample, redmap_filtered(redmap_hit_, redmap_a, redmap_sample), redmap_part(redmap_a),
                redmap_entry != redmap_sample);
  }
#endif
}
