// The grains under a footprint: map/tangent_gather.cpp. Turns are not sorted but counted in bins of an angle, each of
// which stands for the mean of its turns. In the data: both moments' scales, the word at which each level starts, a word a
// texel.
const uint redmap_grain_levels = 16u;
const float redmap_half_turn = 3.14159265;
const int redmap_turn_bins = 128;
vec2 redmap_turns[redmap_drawn_normals];  // cosine and sine, each of the same weight, ordered by angle

// Not handed from function to function, since every hand-over would be a copy: sums of weights, of their squares, and of
// angles times weights.
float redmap_bin_weight[redmap_turn_bins], redmap_bin_squares[redmap_turn_bins], redmap_bin_angle[redmap_turn_bins];

uint redmap_grains_first() { return redmap_word(redmap_rest_first - 1u); }
// Coverage and moments of a texel, 0 to 255.
vec3 redmap_grain(RedmapPatch patch_, int x, int y) {
  uint first = redmap_grains_first() + 2u, row = uint(y * patch_.extent.x + redmap_column(patch_, x));
  uint word = redmap_word(first + redmap_grain_levels + redmap_word(first + patch_.level) + row);
  return vec3(float(word & 255u), float(word >> 8u & 255u), float(word >> 16u));
}

void redmap_count_turn(float angle, float weight) {
  // A grain has no direction: half a turn is none.
  angle -= redmap_half_turn * floor(angle / redmap_half_turn);
  int bin = clamp(int(angle * (float(redmap_turn_bins) / redmap_half_turn)), 0, redmap_turn_bins - 1);
  redmap_bin_weight[bin] += weight;
  redmap_bin_squares[bin] += weight * weight;
  redmap_bin_angle[bin] += weight * angle;
}
// The two turns of a texel (map/tangent_moments.h).
void redmap_count_texel(vec2 moments, float weight) {
  uint first = redmap_grains_first();
  vec2 twice = 2.0 / 255.0 * vec2(redmap_number(first), redmap_number(first + 1u)) * moments - 1.0;
  float middle = 0.5 * atan(twice.y, twice.x), concentration = length(twice);
  float apart = concentration > redmap_one_turn ? 0.0 : 0.5 * acos(concentration);
  redmap_count_turn(middle - apart, 0.5 * weight);
  redmap_count_turn(middle + apart, 0.5 * weight);
}

void redmap_count_patch(RedmapPatch patch_, float part) {
  if (part <= 0.0) return;
  float total = 0.0;
  for (int y = patch_.from.y; y <= patch_.to.y; y++)
    for (int x = patch_.from.x; x <= patch_.to.x; x++)
      total += redmap_overlap(patch_, ivec2(x, y)) * redmap_grain(patch_, x, y).x;
  if (total <= 0.0) return;
  for (int y = patch_.from.y; y <= patch_.to.y; y++)
    for (int x = patch_.from.x; x <= patch_.to.x; x++) {
      vec3 grain = redmap_grain(patch_, x, y);
      float weight = redmap_overlap(patch_, ivec2(x, y)) * grain.x;
      if (weight > 0.0) redmap_count_texel(grain.yz, weight * part / total);
    }
}

// The bin behind the widest gap; -1: all are empty.
int redmap_first_bin() {
  int first = -1, chosen = -1;
  float first_angle = 0.0, last = 0.0, widest = -1.0;
  for (int i = 0; i < redmap_turn_bins; i++) {
    if (redmap_bin_weight[i] <= 0.0) continue;
    float angle = redmap_bin_angle[i] / redmap_bin_weight[i];
    if (first < 0) {
      first = i;
      first_angle = angle;
    } else if (angle - last > widest) {
      widest = angle - last;
      chosen = i;
    }
    last = angle;
  }
  return first_angle + redmap_half_turn - last >= widest ? first : chosen;
}

// Chooses turns up to the weight of `high`, on a line from (weight, turn) `low` to `high`.
int redmap_turns_up_to(int next, float total, vec2 low, vec2 high) {
  for (; next < redmap_drawn_normals; next++) {
    float wanted = total * (float(next) + 0.5) / float(redmap_drawn_normals);
    if (wanted > high.x) break;
    float turn = high.x > low.x ? mix(low.y, high.y, clamp((wanted - low.x) / (high.x - low.x), 0.0, 1.0)) : high.y;
    redmap_turns[next] = vec2(cos(turn), sin(turn));
  }
  return next;
}
// Each turn lies in the middle of its weight, and between two of them all are as likely. Turns of a bin are taken to weigh
// the same, so that half of one lies on either side of them all.
void redmap_choose_turns(int first) {
  float total = 0.0, below = 0.0;
  for (int i = 0; i < redmap_turn_bins; i++) total += redmap_bin_weight[i];
  vec2 low = vec2(0.0, redmap_bin_angle[first] / redmap_bin_weight[first]);
  int next = 0;
  for (int i = 0; i < redmap_turn_bins; i++) {
    int bin = (first + i) % redmap_turn_bins;
    float weight = redmap_bin_weight[bin];
    if (weight <= 0.0) continue;
    float angle = redmap_bin_angle[bin] / weight + (bin < first ? redmap_half_turn : 0.0);
    float half_one = 0.5 * redmap_bin_squares[bin] / weight;
    vec2 begin = vec2(i == 0 ? 0.0 : below + half_one, angle), end = vec2(below + weight - half_one, angle);
    next = redmap_turns_up_to(next, total, low, begin);
    next = redmap_turns_up_to(next, total, begin, end);
    below += weight;
    low = end;
  }
  redmap_turns_up_to(next, total, low, vec2(2.0 * total, low.y));
}

// Those under a hit, as it is seen: frames of hits from behind have their y and z turned around.
void redmap_gather_turns(RedmapHit hit, RedmapAxes axes) {
  RedmapGatherPlan plan = redmap_gather_plan(hit, axes, redmap_gathered_grain_texels);
  for (int i = 0; i < redmap_turn_bins; i++) redmap_bin_weight[i] = redmap_bin_squares[i] = redmap_bin_angle[i] = 0.0;
  redmap_count_patch(plan.fine, 1.0 - plan.coarse_part);
  redmap_count_patch(plan.coarse, plan.coarse_part);
  for (int i = 0; i < redmap_drawn_normals; i++) redmap_turns[i] = vec2(1.0, 0.0);
  int first = redmap_first_bin();
  if (first >= 0) redmap_choose_turns(first);
  if (!hit.turned) return;
  for (int i = 0; i < redmap_drawn_normals; i++) redmap_turns[i].y = -redmap_turns[i].y;
}

// Whether one turn and one normal stand for all.
bool redmap_is_narrow(RedmapNormals normals) {
  vec2 a = redmap_turns[0], b = redmap_turns[redmap_drawn_normals - 1];
  return abs(a.x * b.y - a.y * b.x) < redmap_one_drawn_turn &&
         normals.covariance.x + normals.covariance.z < redmap_one_drawn_normal * redmap_one_drawn_normal;
}
