#include "analysis/directions.h"

#include <cmath>

namespace redmap {
namespace {

/// A line of Fig. 3: elevations from the normal and the rotation between them, in degrees.
struct Angles {
  float incoming, outgoing, rotation;
};

Vec3 direction(float elevation_degrees, float rotation_degrees) {
  const float elevation = elevation_degrees * kPi / 180, rotation = rotation_degrees * kPi / 180;
  return {std::sin(elevation) * std::cos(rotation), std::sin(elevation) * std::sin(rotation), std::cos(elevation)};
}

}  // namespace

DirectionPairs reflection_samples() {
  std::vector<Angles> table{{0, 0, 0}, {0, 2, 0}, {0, 2, 90}, {0, 10, 0}, {0, 10, 90}, {0, 15, 0}};
  for (float t : {30.0f, 45.0f, 60.0f, 85.0f})
    table.insert(
        table.end(),
        {{t, t, 180}, {t, t, 182}, {t, t, 190}, {t, t + 2, 180}, {t, t + 10, 180}, {t, 15, 180}, {t, 75, 180}});
  DirectionPairs pairs;
  pairs.resize(table.size());
  for (std::size_t i = 0; i < table.size(); ++i) {
    pairs.to_light.set(i, direction(table[i].incoming, 0));
    pairs.to_viewer.set(i, direction(table[i].outgoing, table[i].rotation));
  }
  // Padding repeats the first pair: shaders evaluate it too.
  for (std::size_t i = table.size(); i < pairs.to_light.stride(); ++i)
    for (int c = 0; c < 3; ++c) {
      pairs.to_light[c][i] = pairs.to_light[c][0];
      pairs.to_viewer[c][i] = pairs.to_viewer[c][0];
    }
  return pairs;
}

}  // namespace redmap
