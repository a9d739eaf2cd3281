// Cellular noise (Worley 1996): one feature point a lattice cell.
#ifndef REDMAP_WORLEY_GLSL
#define REDMAP_WORLEY_GLSL
#include "include/noise.glsl"

// Distances to the nearest and second nearest feature point, and a number in [0, 1) that belongs to the nearest.
struct Cells {
  float nearest;
  float second;
  float id;
};

float unit_from_bits(uint bits) { return float(int(bits & 1023u)) * (1.0 / 1024.0); }

Cells worley(vec3 p) {
  vec3 cell = floor(p);
  vec3 f = p - cell;
  uint x0 = uint(int(cell.x)) * kHashX;
  uint y0 = uint(int(cell.y)) * kHashY;
  uint z0 = uint(int(cell.z)) * kHashZ;
  float nearest = 1e9;
  float second = 1e9;
  float id = 0.0;
  // The second nearest point can lie outside the 27 cells around; the error is invisible.
  for (int k = -1; k <= 1; k++) {
    for (int j = -1; j <= 1; j++) {
      for (int i = -1; i <= 1; i++) {
        uint h = hash_lattice(x0 + uint(i) * kHashX, y0 + uint(j) * kHashY, z0 + uint(k) * kHashZ);
        vec3 feature = vec3(float(i) + unit_from_bits(h), float(j) + unit_from_bits(h >> 10u),
                            float(k) + unit_from_bits(h >> 20u));
        vec3 to_feature = feature - f;
        float distance2 = dot(to_feature, to_feature);
        bool is_nearest = distance2 < nearest;
        second = min(second, max(distance2, nearest));
        nearest = min(nearest, distance2);
        id = mix(id, unit_from_bits((h * 0x9e3779b1u) >> 22u), is_nearest);
      }
    }
  }
  return Cells(sqrt(nearest), sqrt(second), id);
}

#endif
