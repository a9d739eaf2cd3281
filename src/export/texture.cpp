#include "export/texture.h"

#include <stb/stb_image_write.h>

#include "base/error.h"

namespace redmap {

Texture pack_channels(const std::string& name, const std::vector<const Texture*>& parts, int channels) {
  Texture packed = *parts.front();
  packed.name = name, packed.channels = channels;
  for (std::size_t level = 0; level < packed.levels.size(); ++level) {
    TextureLevel& to = packed.levels[level];
    const std::size_t count = to.texels.size();
    std::vector<std::uint8_t> texels(count * channels, 0);
    for (std::size_t part = 0; part < parts.size(); ++part)
      for (std::size_t i = 0; i < count; ++i) texels[i * channels + part] = parts[part]->levels[level].texels[i];
    to.texels = std::move(texels);
  }
  return packed;
}

Texture stack_layers(const std::string& name, const std::vector<const Texture*>& parts) {
  Texture stacked = *parts.front();
  stacked.name = name, stacked.layers = static_cast<int>(parts.size());
  for (std::size_t level = 0; level < stacked.levels.size(); ++level)
    for (std::size_t part = 1; part < parts.size(); ++part) {
      const std::vector<std::uint8_t>& more = parts[part]->levels[level].texels;
      std::vector<std::uint8_t>& texels = stacked.levels[level].texels;
      texels.insert(texels.end(), more.begin(), more.end());
    }
  return stacked;
}

std::string png_bytes(const Texture& texture) {
  const TextureLevel& base = texture.levels.front();
  std::string bytes;
  const auto append = [](void* to, void* data, int size) {
    static_cast<std::string*>(to)->append(static_cast<const char*>(data), static_cast<std::size_t>(size));
  };
  const int stride = base.extent.width * texture.channels;
  if (!stbi_write_png_to_func(append, &bytes, base.extent.width, base.extent.height, texture.channels,
                              base.texels.data(), stride))
    throw Error("texture '{}': cannot be written as PNG", texture.name);
  return bytes;
}

}  // namespace redmap
