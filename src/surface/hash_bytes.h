// A hash of arrays of plain values: for fingerprints and checksums, not for security.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <vector>

#include "base/random.h"

namespace redmap {

inline std::uint64_t hash_bytes(std::uint64_t hash, const void* data, std::size_t bytes) {
  const auto* at = static_cast<const std::byte*>(data);
  for (std::size_t i = 0; i < bytes; i += 8) {
    std::uint64_t word = 0;
    std::memcpy(&word, at + i, std::min<std::size_t>(8, bytes - i));
    hash = hash64(hash, word);
  }
  return hash64(hash, bytes);
}

/// The values must have no padding.
template <typename T>
std::uint64_t hash_bytes(std::uint64_t hash, const std::vector<T>& values) {
  return hash_bytes(hash, values.data(), values.size() * sizeof(T));
}

}  // namespace redmap
