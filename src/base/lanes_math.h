// Functions of eight floats at once. Transcendental ones go to glibc's vector library (libmvec, errors below 4 units in
// the last place) where the processor has AVX2, and lane by lane to the C library elsewhere.
#pragma once

#include <cmath>

#include "base/lanes.h"

#ifdef __AVX2__
#include <immintrin.h>

// The x86-64 vector ABI's names (libmvec declares them only to the vectoriser): d = AVX2, N = no mask, 8 lanes.
extern "C" {
__m256 _ZGVdN8v_sinf(__m256);
__m256 _ZGVdN8v_cosf(__m256);
__m256 _ZGVdN8v_expf(__m256);
__m256 _ZGVdN8v_exp2f(__m256);
__m256 _ZGVdN8v_logf(__m256);
__m256 _ZGVdN8v_log2f(__m256);
__m256 _ZGVdN8v_atanf(__m256);
__m256 _ZGVdN8vv_atan2f(__m256, __m256);
}
#endif

namespace redmap::lanes {

#ifdef __AVX2__
#define REDMAP_LANES_UNARY(NAME, VECTOR, SCALAR) \
  REDMAP_INLINE Float NAME(Float a) { return (FloatRegister)VECTOR((__m256)a.v); }
#else
#define REDMAP_LANES_UNARY(NAME, VECTOR, SCALAR)                           \
  REDMAP_INLINE Float NAME(Float a) {                                      \
    for (std::size_t i = 0; i < kLanes; ++i) a.v[i] = std::SCALAR(a.v[i]); \
    return a;                                                              \
  }
#endif
REDMAP_LANES_UNARY(floor, _mm256_floor_ps, floor)
REDMAP_LANES_UNARY(sqrt, _mm256_sqrt_ps, sqrt)
REDMAP_LANES_UNARY(sin, _ZGVdN8v_sinf, sin)
REDMAP_LANES_UNARY(cos, _ZGVdN8v_cosf, cos)
REDMAP_LANES_UNARY(exp, _ZGVdN8v_expf, exp)
REDMAP_LANES_UNARY(exp2, _ZGVdN8v_exp2f, exp2)
REDMAP_LANES_UNARY(log, _ZGVdN8v_logf, log)
REDMAP_LANES_UNARY(log2, _ZGVdN8v_log2f, log2)
REDMAP_LANES_UNARY(atan, _ZGVdN8v_atanf, atan)
#undef REDMAP_LANES_UNARY

/// Angle of the point (x, y), in (-pi, pi].
REDMAP_INLINE Float atan(Float y, Float x) {
#ifdef __AVX2__
  return (FloatRegister)_ZGVdN8vv_atan2f((__m256)y.v, (__m256)x.v);
#else
  for (std::size_t i = 0; i < kLanes; ++i) y.v[i] = std::atan2(y.v[i], x.v[i]);
  return y;
#endif
}

REDMAP_INLINE Float min(Float a, Float b) {
#ifdef __AVX2__
  return (FloatRegister)_mm256_min_ps((__m256)a.v, (__m256)b.v);
#else
  return select(a < b, a, b);
#endif
}
REDMAP_INLINE Float max(Float a, Float b) {
#ifdef __AVX2__
  return (FloatRegister)_mm256_max_ps((__m256)a.v, (__m256)b.v);
#else
  return select(a > b, a, b);
#endif
}
REDMAP_INLINE Float abs(Float a) { return (FloatRegister)((IntRegister)a.v & 0x7fffffff); }
REDMAP_INLINE Float clamp(Float a, Float low, Float high) { return min(max(a, low), high); }

/// x^y for x >= 0 and y > 0, as GPUs compute it; relative error about 1e-7 |y log2 x|. Results under 2^-126 are 0:
/// that keeps narrow lobes off the vector library's slow path for underflow.
REDMAP_INLINE Float pow(Float x, Float y) {
  const Float exponent = y * log2(max(x, 0x1p-126f));
  return select(exponent > -126.0f, exp2(clamp(exponent, -126.0f, 127.0f)), 0.0f);
}

}  // namespace redmap::lanes
