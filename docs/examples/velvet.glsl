// Striped velvet as a black box: everything in one function, directions in object space.
struct Parameters {
  float stripes;  // 12 [1, 200] 1/unit: stripes per object unit of height
  vec3 cloth;     // 0.5 0.02 0.08 [0, 1]: colour of the pile
};

vec3 radiance(Surface at, Parameters p, vec3 to_light, vec3 to_viewer) {
  float light = dot(at.normal, to_light), viewer = dot(at.normal, to_viewer);
  if (light <= 0.0 || viewer <= 0.0) return vec3(0.0);
  bool is_satin = fract(at.position.y * p.stripes) < 0.4;
  float rim = pow(1.0 - viewer, 4.0) + pow(1.0 - light, 4.0);
  float shine = pow(max(dot(normalize(to_light + to_viewer), at.normal), 0.0), 40.0);
  vec3 colour = is_satin ? p.cloth / pi + 0.4 * shine : p.cloth * (0.3 / pi + 0.5 * rim);
  return colour * light;
}
