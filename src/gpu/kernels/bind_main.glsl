// Binds the basis, one reflectance an invocation; then finds, in one invocation, which of them may be mixed before they
// are asked: those whose mixed patterns have the mixed radiance. A reflectance joins the first group that it mixes with.

#ifdef REDMAP_MIXES
// Mixtures and pairs of directions that a group is tried with, half of them near the mirror direction; and how far
// off, in parts of the radiance and in all, both may be: roundings of powers.
const uint redmap_trials = 64u;
const float redmap_mixing_part = 1e-3, redmap_mixing_error = 1e-6;

// Uniform in (0, 1) (PCG; Jarzynski and Olano 2020).
uint redmap_state = 1u;
float redmap_next() {
  redmap_state = redmap_state * 747796405u + 2891336453u;
  uint redmap_x = ((redmap_state >> ((redmap_state >> 28u) + 4u)) ^ redmap_state) * 277803737u;
  return (float(((redmap_x >> 22u) ^ redmap_x) >> 9u) + 0.5) * (1.0 / 8388608.0);
}
vec3 redmap_next_direction() {
  float redmap_z = redmap_next(), redmap_turn = 6.2831853 * redmap_next();
  return vec3(sqrt(1.0 - redmap_z * redmap_z) * vec2(cos(redmap_turn), sin(redmap_turn)), redmap_z);
}

// Whether the mixed pattern of some mixture of those up to `redmap_last` that are in a group has the mixed radiance.
bool redmap_mixes_once(uint redmap_g, uint redmap_last, vec3 redmap_l, vec3 redmap_v) {
  Pattern redmap_m = redmap_patterns[redmap_last];
  float redmap_total = 0.0;
  vec3 redmap_sum = vec3(0.0);
  for (uint redmap_b = 0u; redmap_b <= redmap_last; redmap_b++) {
    if (redmap_samples[redmap_b] != redmap_g) continue;
    float redmap_w = -log(redmap_next());
    redmap_total += redmap_w;
    if (redmap_total == redmap_w) redmap_m = redmap_patterns[redmap_b];
    redmap_blend(redmap_m, redmap_patterns[redmap_b], redmap_w / redmap_total);
    redmap_sum += redmap_w * radiance(redmap_patterns[redmap_b], redmap_l, redmap_v);
    redmap_ended(2u);
  }
  vec3 redmap_off = abs(redmap_total * radiance(redmap_m, redmap_l, redmap_v) - redmap_sum);
  redmap_ended(2u);
  float redmap_bound_ = redmap_mixing_part * (redmap_sum.x + redmap_sum.y + redmap_sum.z) + redmap_mixing_error;
  return redmap_off.x + redmap_off.y + redmap_off.z <= redmap_bound_;
}

bool redmap_mixes_all(uint redmap_g, uint redmap_last) {
  bool redmap_yes = true;
  for (uint redmap_i = 0u; redmap_i < redmap_trials && redmap_yes; redmap_i++) {
    vec3 redmap_l = redmap_next_direction(), redmap_v = redmap_next_direction();
    if ((redmap_i & 1u) == 1u)
      redmap_v = normalize(vec3(-redmap_l.xy, redmap_l.z) + 0.3 * redmap_next() * redmap_v);
    redmap_yes = redmap_mixes_once(redmap_g, redmap_last, redmap_l, redmap_v);
  }
  return redmap_yes;
}

void redmap_find_groups() {
  uint redmap_count = 0u;
  for (uint redmap_b = 0u; redmap_b < uint(REDMAP_BASIS); redmap_b++) {
    bool redmap_in = false;
    for (uint redmap_g = 0u; redmap_g < redmap_count && !redmap_in; redmap_g++) {
      redmap_samples[redmap_b] = redmap_g;
      redmap_in = redmap_mixes_all(redmap_g, redmap_b);
    }
    redmap_forget_rounds();
    if (redmap_in) continue;
    redmap_samples[redmap_b] = redmap_count;
    redmap_count++;
  }
}
#endif

void main() {
  uint redmap_i = gl_GlobalInvocationID.x;
#ifdef REDMAP_GUARDED
  if (!redmap_goes_on()) return;
#endif
  if (redmap_stage == redmap_bind_stage) {
    if (redmap_i < uint(REDMAP_BASIS)) redmap_patterns[redmap_i] = redmap_bound(redmap_basis_place(redmap_i));
    redmap_ended(0u);
    return;
  }
#ifdef REDMAP_MIXES
  if (redmap_i == 0u) redmap_find_groups();
#endif
}
