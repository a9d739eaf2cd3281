// The grains under a footprint: map/tangent_gather.cpp. Turns are not sorted but counted in bins of an angle, each of
// which stands for the mean of its turns. In the data: both moments' scales, the byte at which each level starts, the
// bytes, three a texel.
const uint redmap_grain_levels = 16u;
const float redmap_half_turn = 3.14159265;
const int redmap_turn_bins = 64;
vec2 redmap_turns[redmap_drawn_normals];  // cosine and sine, each of the same weight, ordered by angle

struct RedmapBins {
  float weight[redmap_turn_bins], angle[redmap_turn_bins];  // sums; of the angles times weights
};

uint redmap_grains_first() { return redmap_word(redmap_rest_first - 1u); }
uint redmap_grain_byte(uint at) {
  return (redmap_word(redmap_grains_first() + 2u + redmap_grain_levels + (at >> 2u)) >> (8u * (at & 3u))) & 255u;
}
uint redmap_grain_at(RedmapPatch patch_, int x, int y) {
  uint row = uint(y * patch_.extent.x + redmap_column(patch_, x));
  return redmap_word(redmap_grains_first() + 2u + patch_.level) + 3u * row;
}

void redmap_count_turn(float angle, float weight, inout RedmapBins bins) {
  // A grain has no direction: half a turn is none.
  angle -= redmap_half_turn * floor(angle / redmap_half_turn);
  int bin = clamp(int(angle * (float(redmap_turn_bins) / redmap_half_turn)), 0, redmap_turn_bins - 1);
  bins.weight[bin] += weight;
  bins.angle[bin] += weight * angle;
}
// The two turns of a texel (map/tangent_moments.h).
void redmap_count_texel(uint at, float weight, inout RedmapBins bins) {
  uint first = redmap_grains_first();
  float cosine = 2.0 / 255.0 * redmap_number(first) * float(redmap_grain_byte(at + 1u)) - 1.0;
  float sine = 2.0 / 255.0 * redmap_number(first + 1u) * float(redmap_grain_byte(at + 2u)) - 1.0;
  float middle = 0.5 * atan(sine, cosine), concentration = sqrt(cosine * cosine + sine * sine);
  float apart = concentration > redmap_one_turn ? 0.0 : 0.5 * acos(concentration);
  redmap_count_turn(middle - apart, 0.5 * weight, bins);
  redmap_count_turn(middle + apart, 0.5 * weight, bins);
}

void redmap_count_patch(RedmapPatch patch_, float part, inout RedmapBins bins) {
  if (part <= 0.0) return;
  float total = 0.0;
  for (int y = patch_.from.y; y <= patch_.to.y; y++)
    for (int x = patch_.from.x; x <= patch_.to.x; x++)
      total += redmap_overlap(patch_, ivec2(x, y)) * float(redmap_grain_byte(redmap_grain_at(patch_, x, y)));
  if (total <= 0.0) return;
  for (int y = patch_.from.y; y <= patch_.to.y; y++)
    for (int x = patch_.from.x; x <= patch_.to.x; x++) {
      uint at = redmap_grain_at(patch_, x, y);
      float weight = redmap_overlap(patch_, ivec2(x, y)) * float(redmap_grain_byte(at));
      if (weight > 0.0) redmap_count_texel(at, weight * part / total, bins);
    }
}

// The bin behind the widest gap; -1: all are empty.
int redmap_first_bin(RedmapBins bins) {
  int first = -1, chosen = -1;
  float first_angle = 0.0, last = 0.0, widest = -1.0;
  for (int i = 0; i < redmap_turn_bins; i++) {
    if (bins.weight[i] <= 0.0) continue;
    float angle = bins.angle[i] / bins.weight[i];
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

// Each bin lies in the middle of its weight, and between two of them all turns are as likely.
void redmap_choose_turns(RedmapBins bins, int first) {
  float total = 0.0, below = 0.0, low_middle = 0.0, low_angle = 0.0;
  for (int i = 0; i < redmap_turn_bins; i++) total += bins.weight[i];
  int next = 0;
  for (int i = 0; i <= redmap_turn_bins; i++) {
    int bin = (first + i) % redmap_turn_bins;
    bool last = i == redmap_turn_bins;  // what lies beyond the middle of the last
    if (!last && bins.weight[bin] <= 0.0) continue;
    float angle = last ? low_angle : bins.angle[bin] / bins.weight[bin] + (bin < first ? redmap_half_turn : 0.0);
    float middle = last ? total : below + 0.5 * bins.weight[bin];
    if (i == 0) {
      low_middle = middle;
      low_angle = angle;
    }
    for (; next < redmap_drawn_normals; next++) {
      float wanted = total * (float(next) + 0.5) / float(redmap_drawn_normals);
      if (!last && wanted > middle) break;
      float span = middle - low_middle;
      float turn = mix(low_angle, angle, span > 0.0 ? clamp((wanted - low_middle) / span, 0.0, 1.0) : 0.0);
      redmap_turns[next] = vec2(cos(turn), sin(turn));
    }
    below += last ? 0.0 : bins.weight[bin];
    low_middle = middle;
    low_angle = angle;
  }
}

// Those under a hit, as it is seen: frames of hits from behind have their y and z turned around.
void redmap_gather_turns(RedmapHit hit, RedmapAxes axes) {
  RedmapGatherPlan plan = redmap_gather_plan(hit, axes, redmap_gathered_grain_texels);
  RedmapBins bins;
  for (int i = 0; i < redmap_turn_bins; i++) bins.weight[i] = bins.angle[i] = 0.0;
  redmap_count_patch(plan.fine, 1.0 - plan.coarse_part, bins);
  redmap_count_patch(plan.coarse, plan.coarse_part, bins);
  for (int i = 0; i < redmap_drawn_normals; i++) redmap_turns[i] = vec2(1.0, 0.0);
  int first = redmap_first_bin(bins);
  if (first >= 0) redmap_choose_turns(bins, first);
  if (!hit.turned) return;
  for (int i = 0; i < redmap_drawn_normals; i++) redmap_turns[i].y = -redmap_turns[i].y;
}

// Whether one turn and one normal stand for all.
bool redmap_is_narrow(RedmapNormals normals) {
  vec2 a = redmap_turns[0], b = redmap_turns[redmap_drawn_normals - 1];
  return abs(a.x * b.y - a.y * b.x) < redmap_one_drawn_turn &&
         normals.covariance.x + normals.covariance.z < redmap_one_drawn_normal * redmap_one_drawn_normal;
}
