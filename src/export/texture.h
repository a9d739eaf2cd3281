// Textures as they are exported: bytes, every level of the pyramid our own, rows from the top (v = 1) down.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "base/extent.h"

namespace redmap {

/// What the channels of a texture are, for those who write files of it.
enum class TexelMeaning {
  kColor,  ///< R, G and B through the sRGB transfer function
  kData,   ///< value = byte / 255
};

struct TextureLevel {
  Extent extent;
  std::vector<std::uint8_t> texels;  ///< layer by layer, row by row, channels interleaved
  std::uint8_t* texel(int x, int y, int channels, int layer = 0) {
    return &texels[((static_cast<std::size_t>(layer) * extent.height + y) * extent.width + x) * channels];
  }
  const std::uint8_t* texel(int x, int y, int channels, int layer = 0) const {
    return &texels[((static_cast<std::size_t>(layer) * extent.height + y) * extent.width + x) * channels];
  }
};

struct Texture {
  std::string name;
  int channels = 0;
  int layers = 1;
  TexelMeaning meaning = TexelMeaning::kData;
  bool wraps_u = false;
  std::vector<TextureLevel> levels;  ///< the base first, down to 1 x 1
};

/// Textures of one channel and the same extents as the channels of one.
Texture pack_channels(const std::string& name, const std::vector<const Texture*>& parts, int channels);
/// Textures of the same channels and extents as the layers of one.
Texture stack_layers(const std::string& name, const std::vector<const Texture*>& parts);

/// The base as a PNG file of 8 bits: colours are in sRGB already.
std::string png_bytes(const Texture& texture);

}  // namespace redmap
