#include "scene/camera_controls.h"

#include <algorithm>
#include <cmath>

namespace redmap {

namespace {

/// Cameras do not get closer than this to looking along their up direction.
constexpr float kPoleDegrees = 2;

Vec3 rotated(Vec3 v, Vec3 axis, float degrees) {
  const float angle = degrees * (kPi / 180), c = std::cos(angle), s = std::sin(angle);
  return v * c + cross(axis, v) * s + axis * (dot(axis, v) * (1 - c));
}

/// `offset` turned about `up` and then towards or away from it.
Vec3 turned(Vec3 offset, Vec3 up, float right_degrees, float up_degrees) {
  const Vec3 pole = normalized(up), swung = rotated(offset, pole, right_degrees);
  const float from_pole = std::acos(std::clamp(dot(normalized(swung), pole), -1.0f, 1.0f)) * (180 / kPi);
  const float wanted = std::clamp(from_pole - up_degrees, kPoleDegrees, 180 - kPoleDegrees);
  return rotated(swung, normalized(cross(swung, pole)), from_pole - wanted);
}

}  // namespace

void orbit(Camera& camera, float right_degrees, float up_degrees) {
  camera.position = camera.look_at + turned(camera.position - camera.look_at, camera.up, right_degrees, up_degrees);
}

void zoom(Camera& camera, float factor) {
  camera.position = camera.look_at + (camera.position - camera.look_at) * factor;
}

void fly(Camera& camera, float right, float up, float forward) {
  const Vec3 ahead = camera.look_at - camera.position;
  const Vec3 side = normalized(cross(ahead, camera.up)) * length(ahead);
  const Vec3 step = side * right + normalized(cross(side, ahead)) * (length(ahead) * up) + ahead * forward;
  camera.position += step, camera.look_at += step;
}

void look(Camera& camera, float right_degrees, float up_degrees) {
  camera.look_at = camera.position + turned(camera.look_at - camera.position, camera.up, -right_degrees, up_degrees);
}

}  // namespace redmap
