// Functions of eight floats at once. Transcendental ones go to glibc's vector library (libmvec, errors below 4 units in
// the last place) where the processor has AVX2, and lane by lane to the C library elsewhere.
#pragma once

#include <cmath>

#include "base/lanes.h"

#ifdef __AVX2__
#include <immintrin.h>

// The x86-64 vector ABI's names (libmvec declares them only to the vectoriser): d = AVX2, N = no mask, 8 lanes.
// NOLINTBEGIN(bugprone-reserved-identifier, readability-identifier-naming)
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
// NOLINTEND(bugprone-reserved-identifier, readability-identifier-naming)
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

/// x^y for x >= 0 and y > 0, inline since every highlight needs it; relative error about 1e-7 (1 + |y log2 x|), as on
/// GPUs. Results under 2^-126 are 0.
REDMAP_INLINE Float pow(Float x, Float y) {
  // x = mantissa * 2^exponent with the mantissa in [sqrt(1/2), sqrt 2): subtracting the bits of sqrt(1/2) carries.
  constexpr std::int32_t kSqrtHalf = 0x3f3504f3;
  const IntRegister bits = (IntRegister)max(x, 0x1p-126f).v - kSqrtHalf;
  const Float exponent = Float(Int(bits >> 23));
  const Float mantissa = (FloatRegister)((bits & 0x007fffff) + kSqrtHalf);

  // log2 m = 2 / ln 2 * atanh((m - 1) / (m + 1)), five terms of the series: the sixth is below 2^-27.
  const Float s = (mantissa - 1.0f) / (mantissa + 1.0f), s2 = s * s;
  const Float atanh = s + s * s2 * (1.0f / 3 + s2 * (1.0f / 5 + s2 * (1.0f / 7 + s2 * (1.0f / 9))));
  const Float power = y * (exponent + 2.88539008f * atanh);

  // 2^power = 2^whole * 2^part with the part in [-1/2, 1/2], seven terms of its series: the eighth is below 2^-27.
  const Float bounded = clamp(power, -126.0f, 127.0f);
  const Float whole = floor(bounded + 0.5f);
  const Float t = (bounded - whole) * 0.693147181f;
  const Float part =
      1.0f +
      t * (1.0f +
           t * (1.0f / 2 + t * (1.0f / 6 + t * (1.0f / 24 + t * (1.0f / 120 + t * (1.0f / 720 + t * (1.0f / 5040)))))));
  const Float result = (FloatRegister)((IntRegister)part.v + (Int(whole).v << 23));
  return select(power > -126.0f, result, 0.0f);
}

}  // namespace redmap::lanes
