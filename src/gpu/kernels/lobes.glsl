// Integrals of lobe models over Gaussian distributions of normals in closed form: src/lobes/lobe_lanes.cpp, one at a
// time. The model of each basis reflectance stands in the data, with the widths that it uses alone.
const uint redmap_angle_floats = 7u + 3u * uint(REDMAP_WIDTHS);
const uint redmap_model_floats = 4u + uint(REDMAP_WIDTHS) + 9u * redmap_angle_floats;
const uint redmap_drawn_first = uint(REDMAP_BASIS) * (redmap_place_floats + redmap_model_floats);
// What else the map has: normals or clusters and seams, after the word that says where grains start.
const uint redmap_rest_first = redmap_drawn_first + 2u * uint(redmap_drawn_normals) + uint(REDMAP_GRAINS);

// The record of a basis reflectance: narrowest highlight, whether it is to be trusted, how many widths, how bright it
// gets; the widths.
uint redmap_model(uint b) { return uint(REDMAP_BASIS) * redmap_place_floats + b * redmap_model_floats; }
float redmap_width(uint b, uint k) { return redmap_number(redmap_model(b) + 4u + k); }

float redmap_luminance(vec3 c) { return (c.x + c.y + c.z) * (1.0 / 3.0); }

// E[max(0, X)] of a Gaussian: the error function by Abramowitz and Stegun 7.1.26.
float redmap_expected_positive(float mean, float variance) {
  float sigma = sqrt(max(variance, 1e-12)), t = mean / sigma;
  float density = exp(-0.5 * min(t * t, 80.0));
  float u = 1.0 / (1.0 + 0.3275911 * (abs(t) * 0.70710678));
  float series = 0.254829592 + u * (-0.284496736 + u * (1.421413741 + u * (-1.453152027 + u * 1.061405429)));
  float tail = u * series * density * 0.5;
  return max(mean * (t >= 0.0 ? 1.0 - tail : tail) + sigma * density * 0.39894228, 0.0);
}

// Light and viewer about their half vector.
struct RedmapHalf {
  vec3 middle, in_plane, across, to_light;
  float theta_degrees;
};
RedmapHalf redmap_half(vec3 to_light, vec3 to_viewer) {
  RedmapHalf h;
  h.to_light = to_light;
  vec3 sum = to_light + to_viewer;
  float size = length(sum);
  bool has_half = size > redmap_shortest_half;
  h.middle = has_half ? sum / max(size, redmap_shortest_half) : vec3(0.0, 0.0, -1.0);
  float cosine = dot(h.middle, to_light), x = clamp(cosine, 0.0, 1.0);
  // Abramowitz and Stegun 4.4.45.
  h.theta_degrees =
      sqrt(1.0 - x) * (1.5707288 + x * (-0.2121144 + x * (0.0742610 + x * -0.0187293))) * 57.2957795;
  vec3 offset = to_light - h.middle * cosine;
  float norm = length(offset);
  vec3 other = cross(h.middle, abs(h.middle.z) < 0.9 ? vec3(0.0, 0.0, 1.0) : vec3(1.0, 0.0, 0.0));
  h.in_plane = norm > 1e-4 && has_half ? offset / max(norm, 1e-12) : other * inversesqrt(max(dot(other, other), 1e-12));
  h.across = cross(h.middle, h.in_plane);
  return h;
}

// A model at some angle.
struct RedmapLobes {
  vec3 constant, cosine;
  float stretch;
  vec3 amplitude[REDMAP_WIDTHS];
};
RedmapLobes redmap_lobes_at(uint b, float theta_degrees) {
  float position = clamp(theta_degrees * 0.1, 0.0, 8.0), below = min(floor(position), 7.0), part = position - below;
  uint row = redmap_model(b) + 4u + uint(REDMAP_WIDTHS) + uint(below) * redmap_angle_floats, next = row + redmap_angle_floats;
  RedmapLobes lobes;
  lobes.constant = mix(redmap_vector(row), redmap_vector(next), part);
  lobes.cosine = mix(redmap_vector(row + 3u), redmap_vector(next + 3u), part);
  lobes.stretch = mix(redmap_number(row + 6u), redmap_number(next + 6u), part);
  for (uint k = 0u; k < uint(REDMAP_WIDTHS); k++)
    lobes.amplitude[k] = mix(redmap_vector(row + 7u + 3u * k), redmap_vector(next + 7u + 3u * k), part);
  return lobes;
}

// A distribution of unit normals in the shading frame.
struct RedmapNormals {
  vec2 mean;
  vec3 covariance;  // xx, xy, yy
};

// Sums over distributions, each multiplied by a weight.
struct RedmapSums {
  float gaussian[REDMAP_WIDTHS];
  float cosine, in_plane, across, brightness, spread, weight;
  vec2 mean;
};
RedmapSums redmap_no_sums() {
  RedmapSums sums;
  for (int k = 0; k < REDMAP_WIDTHS; k++) sums.gaussian[k] = 0.0;
  sums.cosine = sums.in_plane = sums.across = sums.brightness = sums.spread = sums.weight = 0.0;
  sums.mean = vec2(0.0);
  return sums;
}
void redmap_add_sums(RedmapSums some, float factor, inout RedmapSums sums) {
  for (int k = 0; k < REDMAP_WIDTHS; k++) sums.gaussian[k] += factor * some.gaussian[k];
  sums.cosine += factor * some.cosine;
  sums.in_plane += factor * some.in_plane;
  sums.across += factor * some.across;
  sums.brightness += factor * some.brightness;
  sums.spread += factor * some.spread;
  sums.weight += factor * some.weight;
  sums.mean += factor * some.mean;
}

float redmap_product(vec2 a, vec3 c, vec2 b) {
  return a.x * (c.x * b.x + c.y * b.y) + a.y * (c.y * b.x + c.z * b.y);
}
// How the frame's x and y move the normal's component along `axis`: the normal's z moves with them.
vec2 redmap_row_of(vec3 axis, vec3 mean) { return axis.xy - (axis.z / mean.z) * mean.xy; }

void redmap_add(uint b, RedmapLobes lobes, RedmapHalf half_vector, RedmapNormals normals, float weight,
                inout RedmapSums sums) {
  vec3 c = normals.covariance;
  vec3 mean = vec3(normals.mean, sqrt(max(1.0 - dot(normals.mean, normals.mean), redmap_least_mean_z * redmap_least_mean_z)));
  sums.weight += weight;
  sums.mean += weight * normals.mean;

  // Normals spread around their mean shorten it: their z falls short of the mean's own.
  float shorter = sqrt(max(mean.z * mean.z - c.x - c.z, redmap_least_mean_z * redmap_least_mean_z));
  vec2 light = redmap_row_of(half_vector.to_light, mean);
  float facing = dot(half_vector.to_light, vec3(normals.mean, shorter));
  sums.cosine += weight * redmap_expected_positive(facing, redmap_product(light, c, light));

  vec2 in_plane = redmap_row_of(half_vector.in_plane, mean), across = redmap_row_of(half_vector.across, mean);
  float x = dot(half_vector.in_plane, mean), y = dot(half_vector.across, mean);
  float pxx = redmap_product(in_plane, c, in_plane), pxy = redmap_product(in_plane, c, across),
        pyy = redmap_product(across, c, across);
  float sees = dot(half_vector.middle, mean) > redmap_least_facing ? weight : 0.0;
  for (uint k = 0u; k < uint(REDMAP_WIDTHS); k++) {
    float s = redmap_width(b, k), s2 = s * s;
    float lobe_xx = lobes.stretch * lobes.stretch * s2;
    float xx = pxx + lobe_xx, yy = pyy + s2;
    float inverse = 1.0 / (xx * yy - pxy * pxy);
    float ix = (yy * x - pxy * y) * inverse, iy = (xx * y - pxy * x) * inverse;
    float far = min(0.5 * (x * ix + y * iy), 80.0);
    float g = sees * lobes.stretch * s2 * sqrt(inverse) * exp(-far);
    sums.gaussian[k] += g;
    float bright = g * redmap_luminance(lobes.amplitude[k]);
    sums.in_plane += bright * lobe_xx * ix;
    sums.across += bright * s2 * iy;
    sums.brightness += bright;
    float widths = pxx / lobe_xx + pyy / s2;
    sums.spread += bright * widths / (1.0 + widths);
  }
}

// A model's highlights and the rest.
struct RedmapValue {
  vec3 highlight, smooth_part;
};
RedmapValue redmap_integral(RedmapLobes lobes, RedmapSums sums) {
  RedmapValue value = RedmapValue(vec3(0.0), lobes.constant * sums.weight + lobes.cosine * sums.cosine);
  for (int k = 0; k < REDMAP_WIDTHS; k++) value.highlight += lobes.amplitude[k] * sums.gaussian[k];
  return value;
}
RedmapValue redmap_at_normal(uint b, RedmapLobes lobes, RedmapHalf half_vector, vec3 normal) {
  float x = dot(half_vector.in_plane, normal) / lobes.stretch, y = dot(half_vector.across, normal);
  float radius2 = x * x + y * y;
  bool sees = dot(half_vector.middle, normal) > redmap_least_facing;
  RedmapValue value =
      RedmapValue(vec3(0.0), lobes.constant + lobes.cosine * max(dot(half_vector.to_light, normal), 0.0));
  for (uint k = 0u; k < uint(REDMAP_WIDTHS); k++) {
    float s = redmap_width(b, k);
    value.highlight += lobes.amplitude[k] * (sees ? exp(-min(radius2 * (0.5 / (s * s)), 80.0)) : 0.0);
  }
  return value;
}

// The normal that most of a sum's highlight comes from.
vec3 redmap_brightest(RedmapHalf half_vector, RedmapSums sums) {
  vec2 p = vec2(sums.in_plane, sums.across) / max(sums.brightness, 1e-30);
  float radius2 = dot(p, p);
  p *= radius2 > 0.9 ? sqrt(0.9 / radius2) : 1.0;
  return half_vector.middle * sqrt(1.0 - dot(p, p)) + half_vector.in_plane * p.x + half_vector.across * p.y;
}
// Which way to correct the model, 0 (at the mean normal) to 1 (at the brightest).
float redmap_calibrated_part(RedmapSums sums, RedmapValue whole, RedmapValue at_mean) {
  float there = sums.weight * redmap_luminance(at_mean.highlight), highlight = redmap_luminance(whole.highlight);
  float all = highlight + there + redmap_luminance(whole.smooth_part);
  float change = (abs(highlight - there) + sums.spread) / max(all, 1e-12);
  float t = clamp((change - redmap_corrected_up_to) / (redmap_calibrated_from - redmap_corrected_up_to), 0.0, 1.0);
  return t * t * (3.0 - 2.0 * t);
}
vec3 redmap_corrected(RedmapValue whole, RedmapValue there, vec3 reflectance, float weight) {
  vec3 spread = whole.smooth_part + whole.highlight - weight * (there.smooth_part + there.highlight);
  return max(reflectance + spread, vec3(0.0));
}
vec3 redmap_calibrated(RedmapValue whole, RedmapValue there, vec3 reflectance) {
  vec3 scale = clamp((reflectance - there.smooth_part) / max(there.highlight, vec3(1e-12)), 0.0, redmap_largest_scale);
  return whole.smooth_part + scale * whole.highlight;
}

// Where no model fits, normals are drawn: points of a Gaussian of variance 1, which follow the models in the data.
vec3 redmap_drawn_normal(RedmapNormals normals, int i) {
  uint at = redmap_drawn_first + 2u * uint(i);
  vec2 unit = vec2(redmap_number(at), redmap_number(at + 1u));
  vec3 c = normals.covariance;
  float l11 = sqrt(c.x), l21 = l11 > 0.0 ? c.y / l11 : 0.0;
  float l22 = sqrt(max(0.0, c.z - l21 * l21));
  vec2 xy = normals.mean + vec2(l11 * unit.x, l21 * unit.x + l22 * unit.y);
  float r = length(xy);
  xy *= r > redmap_steepest ? redmap_steepest / r : 1.0;
  return vec3(xy, sqrt(1.0 - dot(xy, xy)));
}
