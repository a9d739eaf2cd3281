// One sample an invocation.
void main() {
  uint redmap_i = gl_GlobalInvocationID.x;
#ifdef REDMAP_GUARDED
  if (!redmap_goes_on()) return;
#endif
#if REDMAP_BASIS > 0
  if (redmap_stage == redmap_bind_stage) {
    if (redmap_i < uint(REDMAP_BASIS)) redmap_patterns[redmap_i] = redmap_bound(redmap_basis_place(redmap_i));
    redmap_ended(0u);
    return;
  }
#endif
  uint redmap_list = redmap_stage - redmap_near_stage;
  if (redmap_i >= redmap_groups[redmap_list].w) return;
  uint redmap_sample = redmap_listed(redmap_list, redmap_i);
  uvec2 redmap_at = redmap_place_of(redmap_sample);
  RedmapHit redmap_hit_ = redmap_hit(texelFetch(redmap_seen, ivec3(redmap_at, 0), 0).x - redmap_numbers.x, redmap_at);
  vec3 redmap_value = vec3(0.0);
  if (redmap_stage == redmap_near_stage) {
    redmap_value = redmap_original(redmap_hit_);
#if REDMAP_CHANNELS > 0
    if (redmap_filters != 0u)
      redmap_value *= 1.0 - redmap_part(redmap_axes(redmap_hit_.duv_dx, redmap_hit_.duv_dy));
#endif
  }
#if REDMAP_CHANNELS > 0
  if (redmap_stage != redmap_near_stage) {
    RedmapAxes redmap_a = redmap_axes(redmap_hit_.duv_dx, redmap_hit_.duv_dy);
    redmap_value = redmap_filtered(redmap_hit_, redmap_a, redmap_sample);
    float redmap_p = redmap_part(redmap_a);
    if (redmap_p < 1.0)
      redmap_value = redmap_value * redmap_p + vec3(redmap_radiance[3u * redmap_sample],
                                                    redmap_radiance[3u * redmap_sample + 1u],
                                                    redmap_radiance[3u * redmap_sample + 2u]);
  }
#endif
  redmap_radiance[3u * redmap_sample] = redmap_value.x;
  redmap_radiance[3u * redmap_sample + 1u] = redmap_value.y;
  redmap_radiance[3u * redmap_sample + 2u] = redmap_value.z;
}
