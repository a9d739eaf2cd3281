// The object's text bound to a place, for frames and for bakes.
REDMAP_BOUND redmap_bound(Surface redmap_at) {
#ifndef REDMAP_BLACK_BOX
  return pattern(redmap_at, redmap_parameters);
#elif defined(REDMAP_PERTURBS) || defined(REDMAP_TURNS)
  vec3 redmap_n = redmap_at.normal, redmap_t = redmap_at.tangent;
#ifdef REDMAP_PERTURBS
  redmap_n = shading_normal(redmap_at, redmap_parameters);
#endif
#ifdef REDMAP_TURNS
  redmap_t = normalize(shading_tangent(redmap_at, redmap_parameters));
#endif
  return redmap_framed(redmap_at, redmap_n, redmap_t);
#else
  return RedmapPlace(redmap_at, redmap_at.normal, redmap_at.tangent);
#endif
}
