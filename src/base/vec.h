// Small vectors and linear RGB, plain floats: everything that is not evaluated in lanes is written with these.
#pragma once

#include <algorithm>
#include <cmath>

namespace redmap {

inline constexpr float kPi = 3.14159265358979f;

struct Vec2 {
  float x = 0, y = 0;
  friend constexpr Vec2 operator+(Vec2 a, Vec2 b) { return {a.x + b.x, a.y + b.y}; }
  friend constexpr Vec2 operator-(Vec2 a, Vec2 b) { return {a.x - b.x, a.y - b.y}; }
  friend constexpr Vec2 operator*(Vec2 a, float s) { return {a.x * s, a.y * s}; }
  friend constexpr bool operator==(const Vec2&, const Vec2&) = default;
};

struct Vec3 {
  float x = 0, y = 0, z = 0;
  constexpr float operator[](int i) const { return i == 0 ? x : i == 1 ? y : z; }
  constexpr float& operator[](int i) { return i == 0 ? x : i == 1 ? y : z; }
  friend constexpr Vec3 operator+(Vec3 a, Vec3 b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
  friend constexpr Vec3 operator-(Vec3 a, Vec3 b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
  friend constexpr Vec3 operator-(Vec3 a) { return {-a.x, -a.y, -a.z}; }
  friend constexpr Vec3 operator*(Vec3 a, float s) { return {a.x * s, a.y * s, a.z * s}; }
  friend constexpr Vec3 operator*(float s, Vec3 a) { return a * s; }
  friend constexpr Vec3 operator/(Vec3 a, float s) { return a * (1.0f / s); }
  constexpr Vec3& operator+=(Vec3 b) { return *this = *this + b; }
  friend constexpr bool operator==(const Vec3&, const Vec3&) = default;
};

constexpr float dot(Vec2 a, Vec2 b) { return a.x * b.x + a.y * b.y; }
constexpr float cross(Vec2 a, Vec2 b) { return a.x * b.y - a.y * b.x; }
constexpr float dot(Vec3 a, Vec3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
constexpr Vec3 cross(Vec3 a, Vec3 b) { return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x}; }
inline float length(Vec2 a) { return std::sqrt(dot(a, a)); }
inline float length(Vec3 a) { return std::sqrt(dot(a, a)); }
/// Unit vector along `a`; the zero vector stays zero.
inline Vec3 normalized(Vec3 a) {
  const float l = length(a);
  return l > 0 ? a / l : a;
}
constexpr Vec3 lerp(Vec3 a, Vec3 b, float t) { return a * (1 - t) + b * t; }

/// Linear RGB, unclamped.
struct Rgb {
  float r = 0, g = 0, b = 0;
  friend constexpr Rgb operator+(Rgb a, Rgb c) { return {a.r + c.r, a.g + c.g, a.b + c.b}; }
  friend constexpr Rgb operator-(Rgb a, Rgb c) { return {a.r - c.r, a.g - c.g, a.b - c.b}; }
  friend constexpr Rgb operator*(Rgb a, Rgb c) { return {a.r * c.r, a.g * c.g, a.b * c.b}; }
  friend constexpr Rgb operator*(Rgb a, float s) { return {a.r * s, a.g * s, a.b * s}; }
  constexpr Rgb& operator+=(Rgb c) { return *this = *this + c; }
  friend constexpr bool operator==(const Rgb&, const Rgb&) = default;
};

/// A right-handed orthonormal frame: z the (shading) normal, x the tangent.
struct Frame {
  Vec3 x, y, z;
  constexpr Vec3 to_local(Vec3 v) const { return {dot(v, x), dot(v, y), dot(v, z)}; }
  constexpr Vec3 to_world(Vec3 v) const { return x * v.x + y * v.y + z * v.z; }
};

/// Frame with z = `normal` (unit) and x along `tangent` made perpendicular; any perpendicular where that vanishes.
inline Frame make_frame(Vec3 normal, Vec3 tangent) {
  Vec3 x = tangent - normal * dot(tangent, normal);
  if (dot(x, x) < 1e-12f * std::max(1e-20f, dot(tangent, tangent)))
    x = std::abs(normal.x) > 0.7f ? cross(Vec3{0, 1, 0}, normal) : cross(Vec3{1, 0, 0}, normal);
  x = normalized(x);
  return {x, cross(normal, x), normal};
}

}  // namespace redmap
