// Hashes and counter-based random numbers: the same (seed, index) gives the same number on every thread and machine.
#pragma once

#include <cstdint>

namespace redmap {

/// A bijective 64-bit mix (the finaliser of SplitMix64, Steele et al. 2014).
constexpr std::uint64_t hash64(std::uint64_t x) {
  x += 0x9E3779B97F4A7C15ull;
  x = (x ^ (x >> 30)) * 0xBF58476D1CE4E5B9ull;
  x = (x ^ (x >> 27)) * 0x94D049BB133111EBull;
  return x ^ (x >> 31);
}
constexpr std::uint64_t hash64(std::uint64_t a, std::uint64_t b) { return hash64(hash64(a) ^ b); }
constexpr std::uint64_t hash64(std::uint64_t a, std::uint64_t b, std::uint64_t c) { return hash64(hash64(a, b) ^ c); }

/// Uniform float in [0, 1) from the top 24 bits.
constexpr float unit_float(std::uint64_t bits) { return static_cast<float>(bits >> 40) * 0x1p-24f; }

/// A stream of random numbers.
class Random {
 public:
  explicit constexpr Random(std::uint64_t seed) : state_(hash64(seed)) {}
  constexpr std::uint64_t next() { return hash64(state_++); }
  constexpr float next_float() { return unit_float(next()); }
  /// Uniform in [0, bound).
  constexpr std::uint32_t below(std::uint32_t bound) {
    return static_cast<std::uint32_t>(((next() >> 32) * bound) >> 32);
  }

 private:
  std::uint64_t state_;
};

}  // namespace redmap
