// Where an object stands in the world at one moment: rotation, scale, translation, both ways.
#pragma once

#include <cmath>

#include "base/vec.h"
#include "scene/scene.h"

namespace redmap {

/// A similarity. Directions are only rotated, so unit vectors stay unit vectors.
struct Placement {
  Frame rotation{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};  ///< columns: where the object's axes point in the world
  Vec3 translate;
  float scale = 1;

  Vec3 point_world(Vec3 object) const { return rotation.to_world(object) * scale + translate; }
  Vec3 point_object(Vec3 world) const { return rotation.to_local(world - translate) / scale; }
  Vec3 direction_world(Vec3 object) const { return rotation.to_world(object); }
  Vec3 direction_object(Vec3 world) const { return rotation.to_local(world); }
};

inline Placement make_placement(const Transform& transform) {
  const auto rotated = [&](Vec3 v) {
    const Vec3 radians = transform.rotate_degrees * (kPi / 180);
    const auto turn = [](float& a, float& b, float angle) {
      const float c = std::cos(angle), s = std::sin(angle), a0 = a;
      a = c * a0 - s * b;
      b = s * a0 + c * b;
    };
    turn(v.y, v.z, radians.x);
    turn(v.z, v.x, radians.y);
    turn(v.x, v.y, radians.z);
    return v;
  };
  return {{rotated({1, 0, 0}), rotated({0, 1, 0}), rotated({0, 0, 1})}, transform.translate, transform.scale};
}

}  // namespace redmap
