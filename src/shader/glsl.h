// Reads GLSL as C++: the types and functions of the part of GLSL that library shaders keep to, where every `float` is
// eight lanes. Include it last in a source file, then the shader text inside a namespace: the macros at its end give
// GLSL's type names a new meaning. Compile with -fsingle-precision-constant, since GLSL's literals have no `f`.
//
// The rule (docs/shaders.md): a text branches only on what is equal in all lanes, such as loop counters; everything
// else selects with mix(a, b, condition).
#pragma once

#include "base/lanes_math.h"

namespace redmap::glsl {

using lanes::Bool;
using lanes::Float;
using lanes::Int;
using lanes::Uint;

using lanes::abs;
using lanes::atan;
using lanes::clamp;
using lanes::cos;
using lanes::exp;
using lanes::exp2;
using lanes::floor;
using lanes::log;
using lanes::log2;
using lanes::max;
using lanes::min;
using lanes::pow;
using lanes::sin;
using lanes::sqrt;

struct Vec2 {
  Float x, y;
  Vec2() = default;
  REDMAP_INLINE Vec2(Float x_, Float y_) : x(x_), y(y_) {}
  REDMAP_INLINE explicit Vec2(Float a) : x(a), y(a) {}
  friend REDMAP_INLINE Vec2 operator+(Vec2 a, Vec2 b) { return {a.x + b.x, a.y + b.y}; }
  friend REDMAP_INLINE Vec2 operator-(Vec2 a, Vec2 b) { return {a.x - b.x, a.y - b.y}; }
  friend REDMAP_INLINE Vec2 operator*(Vec2 a, Vec2 b) { return {a.x * b.x, a.y * b.y}; }
  friend REDMAP_INLINE Vec2 operator*(Vec2 a, Float s) { return {a.x * s, a.y * s}; }
  friend REDMAP_INLINE Vec2 operator*(Float s, Vec2 a) { return a * s; }
};

struct Vec3 {
  Float x, y, z;
  Vec3() = default;
  REDMAP_INLINE Vec3(Float x_, Float y_, Float z_) : x(x_), y(y_), z(z_) {}
  REDMAP_INLINE explicit Vec3(Float a) : x(a), y(a), z(a) {}
  friend REDMAP_INLINE Vec3 operator+(Vec3 a, Vec3 b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
  friend REDMAP_INLINE Vec3 operator-(Vec3 a, Vec3 b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
  friend REDMAP_INLINE Vec3 operator-(Vec3 a) { return {-a.x, -a.y, -a.z}; }
  friend REDMAP_INLINE Vec3 operator*(Vec3 a, Vec3 b) { return {a.x * b.x, a.y * b.y, a.z * b.z}; }
  friend REDMAP_INLINE Vec3 operator*(Vec3 a, Float s) { return {a.x * s, a.y * s, a.z * s}; }
  friend REDMAP_INLINE Vec3 operator*(Float s, Vec3 a) { return a * s; }
  friend REDMAP_INLINE Vec3 operator/(Vec3 a, Float s) { return {a.x / s, a.y / s, a.z / s}; }
  REDMAP_INLINE Vec3& operator+=(Vec3 b) { return *this = *this + b; }
  REDMAP_INLINE Vec3& operator*=(Float s) { return *this = *this * s; }
};

/// Truth values of three components.
struct BoolVec3 {
  Bool x, y, z;
  BoolVec3() = default;
  REDMAP_INLINE explicit BoolVec3(Bool a) : x(a), y(a), z(a) {}
};

REDMAP_INLINE Float mix(Float a, Float b, Float t) { return a + (b - a) * t; }
REDMAP_INLINE Float mix(Float a, Float b, Bool second) { return lanes::select(second, b, a); }
REDMAP_INLINE Vec2 mix(Vec2 a, Vec2 b, Float t) { return {mix(a.x, b.x, t), mix(a.y, b.y, t)}; }
REDMAP_INLINE Vec3 mix(Vec3 a, Vec3 b, Float t) { return {mix(a.x, b.x, t), mix(a.y, b.y, t), mix(a.z, b.z, t)}; }
REDMAP_INLINE Vec3 mix(Vec3 a, Vec3 b, BoolVec3 second) {
  return {mix(a.x, b.x, second.x), mix(a.y, b.y, second.y), mix(a.z, b.z, second.z)};
}

REDMAP_INLINE Float fract(Float a) { return a - floor(a); }
REDMAP_INLINE Float mod(Float a, Float b) { return a - b * floor(a / b); }
REDMAP_INLINE Float inversesqrt(Float a) { return 1.0f / sqrt(a); }
REDMAP_INLINE Float step(Float edge, Float a) { return lanes::select(a < edge, 0.0f, 1.0f); }
REDMAP_INLINE Float sign(Float a) { return lanes::select(a > 0.0f, 1.0f, lanes::select(a < 0.0f, -1.0f, 0.0f)); }
REDMAP_INLINE Float smoothstep(Float low, Float high, Float a) {
  const Float t = clamp((a - low) / (high - low), 0.0f, 1.0f);
  return t * t * (3.0f - 2.0f * t);
}

REDMAP_INLINE Vec2 floor(Vec2 a) { return {floor(a.x), floor(a.y)}; }
REDMAP_INLINE Vec3 floor(Vec3 a) { return {floor(a.x), floor(a.y), floor(a.z)}; }
REDMAP_INLINE Vec2 fract(Vec2 a) { return a - floor(a); }
REDMAP_INLINE Vec3 fract(Vec3 a) { return a - floor(a); }
REDMAP_INLINE Vec3 abs(Vec3 a) { return {abs(a.x), abs(a.y), abs(a.z)}; }
REDMAP_INLINE Vec3 min(Vec3 a, Vec3 b) { return {min(a.x, b.x), min(a.y, b.y), min(a.z, b.z)}; }
REDMAP_INLINE Vec3 max(Vec3 a, Vec3 b) { return {max(a.x, b.x), max(a.y, b.y), max(a.z, b.z)}; }

REDMAP_INLINE Float dot(Vec2 a, Vec2 b) { return a.x * b.x + a.y * b.y; }
REDMAP_INLINE Float dot(Vec3 a, Vec3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
REDMAP_INLINE Vec3 cross(Vec3 a, Vec3 b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
REDMAP_INLINE Float length(Vec2 a) { return sqrt(dot(a, a)); }
REDMAP_INLINE Float length(Vec3 a) { return sqrt(dot(a, a)); }
REDMAP_INLINE Vec3 normalize(Vec3 a) { return a * inversesqrt(dot(a, a)); }
REDMAP_INLINE Vec3 reflect(Vec3 incident, Vec3 normal) { return incident - normal * (2.0f * dot(normal, incident)); }

}  // namespace redmap::glsl

#define float redmap::glsl::Float
#define int redmap::glsl::Int
#define uint redmap::glsl::Uint
#define bool redmap::glsl::Bool
#define vec2 redmap::glsl::Vec2
#define vec3 redmap::glsl::Vec3
#define bvec3 redmap::glsl::BoolVec3

namespace redmap::glsl {
#include "shader/library/include/prelude.glsl"
}  // namespace redmap::glsl
