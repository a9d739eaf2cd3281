// Places and directions for the tests of shaders.
#pragma once

#include <cmath>

#include "base/random.h"
#include "shader/shader.h"

namespace redmap::test {

inline Vec3 random_unit(Random& random) {
  const float z = 2 * random.next_float() - 1, angle = 2 * kPi * random.next_float();
  const float r = std::sqrt(std::max(0.0f, 1 - z * z));
  return {r * std::cos(angle), r * std::sin(angle), z};
}

inline Vec3 random_upper(Random& random) {
  const Vec3 v = random_unit(random);
  return {v.x, v.y, std::abs(v.z)};
}

/// Places on and around the unit sphere.
inline SurfacePoints random_points(std::size_t count, std::uint64_t seed) {
  Random random(seed);
  SurfacePoints points;
  points.resize(count);
  for (std::size_t i = 0; i < count; ++i) {
    const Vec3 normal = random_unit(random);
    points.position.set(i, normal * (0.5f + random.next_float()));
    points.normal.set(i, normal);
    points.tangent.set(i, make_frame(normal, random_unit(random)).x);
    points.uv.set(i, Vec2{random.next_float(), random.next_float()});
  }
  return points;
}

/// Point `i` of `points`, `count` times.
inline SurfacePoints repeated(const SurfacePoints& points, std::size_t i, std::size_t count) {
  SurfacePoints same;
  same.resize(count);
  same.time = points.time;
  for (std::size_t j = 0; j < count; ++j) {
    same.position.set(j, points.position.get(i));
    same.normal.set(j, points.normal.get(i));
    same.tangent.set(j, points.tangent.get(i));
    same.uv.set(j, Vec2{points.uv[0][i], points.uv[1][i]});
  }
  return same;
}

inline DirectionPairs random_pairs(std::size_t count, std::uint64_t seed) {
  Random random(seed);
  DirectionPairs pairs;
  pairs.resize(count);
  for (std::size_t i = 0; i < count; ++i) {
    pairs.to_light.set(i, random_upper(random));
    pairs.to_viewer.set(i, random_upper(random));
  }
  return pairs;
}

}  // namespace redmap::test
