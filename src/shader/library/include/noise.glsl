// Gradient noise (Perlin 1985, 2002) on hashed integer lattices, and sums of its octaves.
#ifndef REDMAP_NOISE_GLSL
#define REDMAP_NOISE_GLSL

// Mixes the three terms below: two rounds of shift and multiplication, of the kind that Wellons (2018) searched for low
// bias.
uint hash_lattice(uint x, uint y, uint z) {
  uint h = x ^ y ^ z;
  h ^= h >> 15u;
  h *= 0x2c1b3c6du;
  h ^= h >> 12u;
  h *= 0x297a2d39u;
  h ^= h >> 15u;
  return h;
}

// A lattice point's terms are its coordinates times these (Ericson, Real-Time Collision Detection, 2005); the
// next point along an axis adds the axis's multiplier.
const uint kHashX = 0x8da6b343u;
const uint kHashY = 0xd8163841u;
const uint kHashZ = 0xcb1ab31fu;

// Component in [-sqrt 2, sqrt 2] from ten bits: the variance is that of Perlin's twelve gradients.
float gradient_component(uint bits) { return float(int(bits & 1023u)) * (2.8284271 / 1023.0) - 1.4142136; }

float lattice_gradient(uint h, float x, float y, float z) {
  return gradient_component(h) * x + gradient_component(h >> 10u) * y + gradient_component(h >> 20u) * z;
}

// Smooth noise of mean 0, about [-1, 1], one feature a unit; zero at integer lattice points.
float gradient_noise(vec3 p) {
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
  float n00 = mix(lattice_gradient(hash_lattice(x0, y0, z0), f.x, f.y, f.z),
                  lattice_gradient(hash_lattice(x1, y0, z0), g.x, f.y, f.z), u.x);
  float n10 = mix(lattice_gradient(hash_lattice(x0, y1, z0), f.x, g.y, f.z),
                  lattice_gradient(hash_lattice(x1, y1, z0), g.x, g.y, f.z), u.x);
  float n01 = mix(lattice_gradient(hash_lattice(x0, y0, z1), f.x, f.y, g.z),
                  lattice_gradient(hash_lattice(x1, y0, z1), g.x, f.y, g.z), u.x);
  float n11 = mix(lattice_gradient(hash_lattice(x0, y1, z1), f.x, g.y, g.z),
                  lattice_gradient(hash_lattice(x1, y1, z1), g.x, g.y, g.z), u.x);
  return mix(mix(n00, n10, u.y), mix(n01, n11, u.y), u.z);
}

// Sum of octaves of halving amplitude (Perlin 1985). The lacunarity is not 2, so that lattices do not line up.
float fbm(vec3 p, int octaves) {
  float sum = 0.0;
  float amplitude = 1.0;
  for (int i = 0; i < octaves; i++) {
    sum += amplitude * gradient_noise(p);
    p = p * 2.03;
    amplitude *= 0.5;
  }
  return sum;
}

// The same with a crease at every zero of every octave; always positive.
float turbulence(vec3 p, int octaves) {
  float sum = 0.0;
  float amplitude = 1.0;
  for (int i = 0; i < octaves; i++) {
    sum += amplitude * abs(gradient_noise(p));
    p = p * 2.03;
    amplitude *= 0.5;
  }
  return sum;
}

#endif
