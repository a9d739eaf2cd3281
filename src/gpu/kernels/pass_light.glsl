// How much light passes an object on its way to what the samples see: transmittance_along() of render/wavefront.cpp, one
// sample an invocation. The footprint on the object is as wide as that of the sample.
vec3 redmap_passes_itself(RedmapHit redmap_hit_) {
  Pattern redmap_m = pattern(redmap_hit_place(redmap_hit_), redmap_parameters);
  redmap_ended(0u);
  vec3 redmap_value = transmittance(redmap_m);
  redmap_ended(3u);
  return redmap_value;
}

vec3 redmap_passes(RedmapHit redmap_hit_) {
#if REDMAP_CHANNELS > 0
  RedmapAxes redmap_a = redmap_axes(redmap_hit_.duv_dx, redmap_hit_.duv_dy);
  float redmap_p = redmap_filters != 0u ? redmap_part(redmap_a) : 0.0;
  vec3 redmap_value = vec3(0.0);
  if (redmap_p > 0.0) redmap_value = redmap_p * redmap_behind_of(redmap_look_up(redmap_hit_.uv, redmap_a));
  if (redmap_p < 1.0) redmap_value += (1.0 - redmap_p) * redmap_passes_itself(redmap_hit_);
  return redmap_value;
#else
  return redmap_passes_itself(redmap_hit_);
#endif
}

vec3 redmap_let_through(uint redmap_triangle, RedmapLightRay redmap_ray) {
  RedmapHit redmap_hit_;
  redmap_hit_.turned = false;
  redmap_complete(redmap_triangle, redmap_ray.origin, redmap_ray.direction, redmap_hit_);
  vec3 redmap_x = redmap_perpendicular(redmap_hit_.geometric, redmap_hit_.dp_du);
  redmap_hit_.duv_dx = redmap_uv_change(redmap_hit_, redmap_x * redmap_ray.width);
  redmap_hit_.duv_dy = redmap_uv_change(redmap_hit_, cross(redmap_hit_.geometric, redmap_x) * redmap_ray.width);
  return redmap_passes(redmap_hit_);
}

void redmap_pass_light(uint redmap_sample) {
  if (redmap_sample >= redmap_picture.x * redmap_rows) return;
  if (texelFetch(redmap_seen, ivec3(redmap_place_of(redmap_sample), 0), 0).x == 0u) return;
  vec4 redmap_from = redmap_paths[redmap_path(redmap_receiver, redmap_sample)];
  RedmapLightRay redmap_ray;
  redmap_ray.origin = redmap_point_to_object(redmap_from.xyz);
  redmap_ray.width = redmap_from.w / redmap_shape.x;
  for (uint redmap_i = 0u; redmap_i < redmap_picture.z; redmap_i++) {
    RedmapLight redmap_l = redmap_lights[redmap_i];
    if (redmap_l.intensity.w < 0.0) continue;
    bool redmap_is_point = redmap_l.place.w > 0.5;
    vec3 redmap_way = redmap_is_point ? redmap_l.place.xyz - redmap_from.xyz : redmap_l.place.xyz;
    redmap_ray.direction = redmap_to_object(normalize(redmap_way));
    redmap_ray.reach = redmap_is_point ? length(redmap_way) / redmap_shape.x : 1e30;
    redmap_paths[redmap_path(redmap_first_light + redmap_i, redmap_sample)].xyz *= redmap_passed_along(redmap_ray);
  }
}
