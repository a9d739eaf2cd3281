// Hashing of plain memory.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>

#include "base/random.h"

namespace redmap {

/// Continues `hash` over `bytes` bytes at `data`.
inline std::uint64_t hash_bytes(std::uint64_t hash, const void* data, std::size_t bytes) {
  const char* at = static_cast<const char*>(data);
  for (std::size_t i = 0; i < bytes; i += sizeof(std::uint64_t)) {
    std::uint64_t word = 0;
    std::memcpy(&word, at + i, std::min(sizeof(word), bytes - i));
    hash = hash64(hash, word);
  }
  return hash64(hash, bytes);
}

}  // namespace redmap
