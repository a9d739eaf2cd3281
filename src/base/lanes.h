// Eight floats, integers or truth values at once: one 256-bit register each, in GCC's and Clang's vector extension.
//
// Every operation works on each lane by itself, so a value never depends on which lane it is computed in. A Bool is a
// mask: all bits of a lane set, or none.
#pragma once

#include <cassert>
#include <cstdint>
#include <cstring>

#include "base/surface_points.h"

#define REDMAP_INLINE inline __attribute__((always_inline))

namespace redmap::lanes {

typedef float FloatRegister __attribute__((vector_size(kLanes * sizeof(float))));
typedef std::int32_t IntRegister __attribute__((vector_size(kLanes * sizeof(std::int32_t))));
typedef std::uint32_t UintRegister __attribute__((vector_size(kLanes * sizeof(std::uint32_t))));

/// Eight truth values.
struct Bool {
  IntRegister v;
  Bool() = default;
  REDMAP_INLINE constexpr Bool(IntRegister mask) : v(mask) {}
  REDMAP_INLINE constexpr Bool(bool b) : v(IntRegister{} - (b ? 1 : 0)) {}

  /// For branches and loops: all lanes must agree, which builds with assertions check.
  REDMAP_INLINE explicit operator bool() const {
#ifndef NDEBUG
    for (std::size_t i = 1; i < kLanes; ++i) assert(v[i] == v[0] && "a branch on a value that differs between lanes");
#endif
    return v[0] != 0;
  }
  friend REDMAP_INLINE Bool operator&&(Bool a, Bool b) { return a.v & b.v; }
  friend REDMAP_INLINE Bool operator||(Bool a, Bool b) { return a.v | b.v; }
  friend REDMAP_INLINE Bool operator!(Bool a) { return ~a.v; }
};

struct Uint;
struct Float;

/// Eight signed integers that wrap around.
struct Int {
  IntRegister v;
  Int() = default;
  REDMAP_INLINE constexpr Int(IntRegister r) : v(r) {}
  REDMAP_INLINE constexpr Int(std::int32_t i) : v(IntRegister{} + i) {}
  REDMAP_INLINE explicit Int(Bool b) : v(-b.v) {}
  REDMAP_INLINE explicit Int(Uint u);
  REDMAP_INLINE explicit Int(Float f);

  // Wraps around without undefined behaviour: the unsigned sum has the same bits.
  friend REDMAP_INLINE Int operator+(Int a, Int b) { return (IntRegister)((UintRegister)a.v + (UintRegister)b.v); }
  friend REDMAP_INLINE Int operator-(Int a, Int b) { return (IntRegister)((UintRegister)a.v - (UintRegister)b.v); }
  friend REDMAP_INLINE Int operator*(Int a, Int b) { return (IntRegister)((UintRegister)a.v * (UintRegister)b.v); }
  friend REDMAP_INLINE Int operator-(Int a) { return Int(0) - a; }
  friend REDMAP_INLINE Int operator&(Int a, Int b) { return a.v & b.v; }
  REDMAP_INLINE Int& operator+=(Int b) { return *this = *this + b; }
  REDMAP_INLINE Int& operator++() { return *this += 1; }
  REDMAP_INLINE Int operator++(int) {
    const Int before = *this;
    *this += 1;
    return before;
  }
  friend REDMAP_INLINE Bool operator<(Int a, Int b) { return IntRegister(a.v < b.v); }
  friend REDMAP_INLINE Bool operator<=(Int a, Int b) { return IntRegister(a.v <= b.v); }
  friend REDMAP_INLINE Bool operator>(Int a, Int b) { return IntRegister(a.v > b.v); }
  friend REDMAP_INLINE Bool operator>=(Int a, Int b) { return IntRegister(a.v >= b.v); }
  friend REDMAP_INLINE Bool operator==(Int a, Int b) { return IntRegister(a.v == b.v); }
  friend REDMAP_INLINE Bool operator!=(Int a, Int b) { return IntRegister(a.v != b.v); }
};

/// Eight unsigned integers, for hashes.
struct Uint {
  UintRegister v;
  Uint() = default;
  REDMAP_INLINE constexpr Uint(UintRegister r) : v(r) {}
  REDMAP_INLINE constexpr Uint(std::uint32_t u) : v(UintRegister{} + u) {}
  REDMAP_INLINE explicit Uint(Int i) : v((UintRegister)i.v) {}

  friend REDMAP_INLINE Uint operator+(Uint a, Uint b) { return a.v + b.v; }
  friend REDMAP_INLINE Uint operator*(Uint a, Uint b) { return a.v * b.v; }
  friend REDMAP_INLINE Uint operator&(Uint a, Uint b) { return a.v & b.v; }
  friend REDMAP_INLINE Uint operator^(Uint a, Uint b) { return a.v ^ b.v; }
  friend REDMAP_INLINE Uint operator>>(Uint a, std::uint32_t bits) { return a.v >> bits; }
  REDMAP_INLINE Uint& operator*=(Uint b) { return *this = *this * b; }
  REDMAP_INLINE Uint& operator^=(Uint b) { return *this = *this ^ b; }
};

/// Eight floats.
struct Float {
  FloatRegister v;
  Float() = default;
  REDMAP_INLINE constexpr Float(FloatRegister r) : v(r) {}
  REDMAP_INLINE constexpr Float(float f) : v(FloatRegister{} + f) {}
  REDMAP_INLINE explicit Float(Int i) : v(__builtin_convertvector(i.v, FloatRegister)) {}

  friend REDMAP_INLINE Float operator+(Float a, Float b) { return a.v + b.v; }
  friend REDMAP_INLINE Float operator-(Float a, Float b) { return a.v - b.v; }
  friend REDMAP_INLINE Float operator*(Float a, Float b) { return a.v * b.v; }
  friend REDMAP_INLINE Float operator/(Float a, Float b) { return a.v / b.v; }
  friend REDMAP_INLINE Float operator-(Float a) { return -a.v; }
  REDMAP_INLINE Float& operator+=(Float b) { return *this = *this + b; }
  REDMAP_INLINE Float& operator-=(Float b) { return *this = *this - b; }
  REDMAP_INLINE Float& operator*=(Float b) { return *this = *this * b; }
  friend REDMAP_INLINE Bool operator<(Float a, Float b) { return IntRegister(a.v < b.v); }
  friend REDMAP_INLINE Bool operator<=(Float a, Float b) { return IntRegister(a.v <= b.v); }
  friend REDMAP_INLINE Bool operator>(Float a, Float b) { return IntRegister(a.v > b.v); }
  friend REDMAP_INLINE Bool operator>=(Float a, Float b) { return IntRegister(a.v >= b.v); }
  friend REDMAP_INLINE Bool operator==(Float a, Float b) { return IntRegister(a.v == b.v); }
  friend REDMAP_INLINE Bool operator!=(Float a, Float b) { return IntRegister(a.v != b.v); }
};

Int::Int(Uint u) : v((IntRegister)u.v) {}
/// Towards zero. Values beyond 2^31 give any integer.
Int::Int(Float f) : v(__builtin_convertvector(f.v, IntRegister)) {}

/// kLanes floats from and to memory, which need not be aligned.
REDMAP_INLINE Float load(const float* from) {
  FloatRegister r;
  std::memcpy(&r, from, sizeof r);
  return r;
}
REDMAP_INLINE void store(float* to, Float value) { std::memcpy(to, &value.v, sizeof value.v); }

/// Of all lanes.
REDMAP_INLINE float sum(Float f) {
  return ((f.v[0] + f.v[1]) + (f.v[2] + f.v[3])) + ((f.v[4] + f.v[5]) + (f.v[6] + f.v[7]));
}

/// `yes` where `condition` holds, else `no`.
REDMAP_INLINE Float select(Bool condition, Float yes, Float no) { return condition.v ? yes.v : no.v; }

}  // namespace redmap::lanes
