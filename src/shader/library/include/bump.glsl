// Bumps: normals tilted by the gradient of a height over the surface (Blinn 1978), and the gradient of noise.
#ifndef REDMAP_BUMP_GLSL
#define REDMAP_BUMP_GLSL
#include "include/noise.glsl"

// Normal of the surface raised by a height whose gradient in object space is `gradient`.
vec3 bumped_normal(vec3 normal, vec3 gradient) {
  return normalize(normal - (gradient - normal * dot(normal, gradient)));
}

// Unit vector around the y axis, and the distance from it, but not zero.
vec3 around_y(vec3 position) {
  return vec3(-position.z, 0.0, position.x) * inversesqrt(max(dot(position, position) - position.y * position.y, 1e-6));
}
float distance_from_y(vec3 position) {
  return sqrt(max(dot(position, position) - position.y * position.y, 1e-6));
}

vec3 gradient_vector(uint h) {
  return vec3(gradient_component(h), gradient_component(h >> 10u), gradient_component(h >> 20u));
}

// Gradient of gradient_noise().
vec3 noise_gradient(vec3 p) {
  vec3 cell = floor(p);
  vec3 f = p - cell;
  vec3 g = f - vec3(1.0);
  uint x0 = uint(int(cell.x)) * kHashX;
  uint y0 = uint(int(cell.y)) * kHashY;
  uint z0 = uint(int(cell.z)) * kHashZ;
  uint x1 = x0 + kHashX;
  uint y1 = y0 + kHashY;
  uint z1 = z0 + kHashZ;
  vec3 u = f * f * f * (f * (f * 6.0 - vec3(15.0)) + vec3(10.0));
  vec3 du = f * f * (f * (f * 30.0 - vec3(60.0)) + vec3(30.0));

  // The lattice's gradients, and the values they have at p.
  vec3 g000 = gradient_vector(hash_lattice(x0, y0, z0));
  vec3 g100 = gradient_vector(hash_lattice(x1, y0, z0));
  vec3 g010 = gradient_vector(hash_lattice(x0, y1, z0));
  vec3 g110 = gradient_vector(hash_lattice(x1, y1, z0));
  vec3 g001 = gradient_vector(hash_lattice(x0, y0, z1));
  vec3 g101 = gradient_vector(hash_lattice(x1, y0, z1));
  vec3 g011 = gradient_vector(hash_lattice(x0, y1, z1));
  vec3 g111 = gradient_vector(hash_lattice(x1, y1, z1));
  float v000 = dot(g000, f);
  float v100 = dot(g100, vec3(g.x, f.y, f.z));
  float v010 = dot(g010, vec3(f.x, g.y, f.z));
  float v110 = dot(g110, vec3(g.x, g.y, f.z));
  float v001 = dot(g001, vec3(f.x, f.y, g.z));
  float v101 = dot(g101, vec3(g.x, f.y, g.z));
  float v011 = dot(g011, vec3(f.x, g.y, g.z));
  float v111 = dot(g111, g);

  // Product rule: interpolated gradients, and the interpolation's own change.
  vec3 smooth_part = mix(mix(mix(g000, g100, u.x), mix(g010, g110, u.x), u.y),
                         mix(mix(g001, g101, u.x), mix(g011, g111, u.x), u.y), u.z);
  float dx = mix(mix(v100 - v000, v110 - v010, u.y), mix(v101 - v001, v111 - v011, u.y), u.z);
  float dy = mix(mix(v010 - v000, v110 - v100, u.x), mix(v011 - v001, v111 - v101, u.x), u.z);
  float dz = mix(mix(v001 - v000, v101 - v100, u.x), mix(v011 - v010, v111 - v110, u.x), u.y);
  return smooth_part + du * vec3(dx, dy, dz);
}

// Gradient of fbm().
vec3 fbm_gradient(vec3 p, int octaves) {
  vec3 sum = vec3(0.0);
  float amplitude = 1.0;
  float frequency = 1.0;
  for (int i = 0; i < octaves; i++) {
    sum += amplitude * frequency * noise_gradient(p);
    p = p * 2.03;
    amplitude *= 0.5;
    frequency *= 2.03;
  }
  return sum;
}

// The same with slopes along the surface of 1, root mean square: a component of fbm_gradient() has kNoiseSlope an octave
// (measured; tests/shader holds it).
const float kNoiseSlope = 0.775;
vec3 unit_bumps(vec3 p, int octaves) {
  return fbm_gradient(p, octaves) * (inversesqrt(2.0 * float(octaves)) / kNoiseSlope);
}

#endif
