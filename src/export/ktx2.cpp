#include "export/ktx2.h"

#include <algorithm>
#include <array>

namespace redmap {

namespace {

// VkFormat of 1, 2 and 4 channels: R8, R8G8, R8G8B8A8; UNORM and SRGB.
constexpr std::array<std::uint32_t, 5> kNumbers{0, 9, 16, 0, 37}, kColors{0, 15, 22, 0, 43};
constexpr std::size_t kHeaderBytes = 80, kLevelIndexBytes = 24;

void append(std::uint64_t value, int bytes, std::string& to) {
  for (int i = 0; i < bytes; ++i) to.push_back(static_cast<char>(value >> (8 * i) & 255));
}
void pad(std::size_t alignment, std::string& to) { to.resize((to.size() + alignment - 1) / alignment * alignment); }

/// Data format descriptor: one basic block (Khronos Data Format Specification 1.3, section 5).
std::string format_descriptor(int channels, bool is_color) {
  const std::uint64_t block = 24 + 16 * static_cast<std::uint64_t>(channels);
  std::string bytes;
  append(4 + block, 4, bytes);
  append(0, 4, bytes);  // vendor Khronos, basic format
  append(2, 2, bytes);  // version 1.3
  append(block, 2, bytes);
  append(1, 1, bytes);                                     // RGBSDA
  append(1, 1, bytes);                                     // primaries of BT.709
  append(is_color ? 2 : 1, 1, bytes);                      // transfer function: sRGB or linear
  append(0, 1, bytes);                                     // alpha is straight
  append(0, 4, bytes);                                     // blocks of one texel
  append(static_cast<std::uint64_t>(channels), 8, bytes);  // bytes of the only plane
  for (int c = 0; c < channels; ++c) {
    constexpr std::uint64_t kAlpha = 15, kLinear = 16;
    append(8 * static_cast<std::uint64_t>(c), 2, bytes);
    append(7, 1, bytes);  // bits - 1
    append(c == 3 ? (is_color ? kAlpha | kLinear : kAlpha) : static_cast<std::uint64_t>(c), 1, bytes);
    append(0, 4, bytes);
    append(0, 4, bytes), append(255, 4, bytes);  // what stands for 0 and 1
  }
  return bytes;
}

std::string key_values(bool rows_down) {
  std::string bytes;
  const auto add = [&](std::string key, const std::string& value) {
    key.push_back('\0');
    key += value;
    key.push_back('\0');
    append(key.size(), 4, bytes);
    bytes += key;
    pad(4, bytes);
  };
  add("KTXorientation", rows_down ? "rd" : "ru");
  add("KTXwriter", "redmap");
  return bytes;
}

/// A level with rows in the order asked for and no three channels.
std::string level_bytes(const Texture& texture, const TextureLevel& level, int channels, bool rows_down) {
  std::string bytes;
  for (int layer = 0; layer < texture.layers; ++layer)
    for (int row = 0; row < level.extent.height; ++row)
      for (int x = 0; x < level.extent.width; ++x) {
        const int y = rows_down ? row : level.extent.height - 1 - row;
        const std::uint8_t* texel = level.texel(x, y, texture.channels, layer);
        for (int c = 0; c < channels; ++c) bytes.push_back(static_cast<char>(c < texture.channels ? texel[c] : 255));
      }
  return bytes;
}

}  // namespace

std::string ktx2_bytes(const Texture& texture, bool rows_down) {
  const int channels = texture.channels == 3 ? 4 : texture.channels;
  const bool is_color = texture.meaning == TexelMeaning::kColor;
  const std::string descriptor = format_descriptor(channels, is_color), keys = key_values(rows_down);
  const std::size_t levels = texture.levels.size();
  const std::size_t descriptor_at = kHeaderBytes + kLevelIndexBytes * levels;

  std::string bytes = "\xABKTX 20\xBB\r\n\x1A\n";
  append(is_color ? kColors[channels] : kNumbers[channels], 4, bytes);
  append(1, 4, bytes);  // bytes of a component
  append(static_cast<std::uint64_t>(texture.levels.front().extent.width), 4, bytes);
  append(static_cast<std::uint64_t>(texture.levels.front().extent.height), 4, bytes);
  append(0, 4, bytes);  // no depth
  append(texture.layers > 1 ? static_cast<std::uint64_t>(texture.layers) : 0, 4, bytes);
  append(1, 4, bytes);  // face
  append(levels, 4, bytes);
  append(0, 4, bytes);  // not compressed
  append(descriptor_at, 4, bytes), append(descriptor.size(), 4, bytes);
  append(descriptor_at + descriptor.size(), 4, bytes), append(keys.size(), 4, bytes);
  append(0, 8, bytes), append(0, 8, bytes);

  // The smallest level comes first in the file, the largest in the index.
  std::string data;
  std::vector<std::array<std::uint64_t, 2>> places(levels);
  const std::size_t data_at = descriptor_at + descriptor.size() + keys.size();
  for (std::size_t i = levels; i-- > 0;) {
    const std::string level = level_bytes(texture, texture.levels[i], channels, rows_down);
    data.resize((data_at + data.size() + 3) / 4 * 4 - data_at);
    places[i] = {data_at + data.size(), level.size()};
    data += level;
  }
  for (const auto& [at, size] : places) append(at, 8, bytes), append(size, 8, bytes), append(size, 8, bytes);
  return bytes + descriptor + keys + data;
}

}  // namespace redmap
