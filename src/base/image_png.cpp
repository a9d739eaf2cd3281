// PNG and JPEG pictures through stb: 8 or 16 bits in, 8 bits out as PNG, colour through the sRGB transfer function.
#include <stb/stb_image.h>
#include <stb/stb_image_write.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>

#include "base/atomic_file.h"
#include "base/error.h"
#include "base/image_files.h"
#include "base/srgb.h"

namespace redmap {

namespace {

struct FreePixels {
  void operator()(void* pixels) const { stbi_image_free(pixels); }
};

/// Grey with alpha and RGB with alpha end in a channel that is not light.
bool is_alpha(int channel, int channels) { return channels % 2 == 0 && channel == channels - 1; }

template <typename Stored>
Image to_linear(const Stored* stored, int width, int height, int channels, float largest) {
  Image image(width, height, channels);
  for (std::size_t i = 0; i < image.data.size(); ++i) {
    const float value = static_cast<float>(stored[i]) / largest;
    image.data[i] = is_alpha(static_cast<int>(i % channels), channels) ? value : srgb_to_linear(value);
  }
  return image;
}

/// The big-endian number that starts at `bytes`.
long long read_big_endian(const stbi_uc* bytes) {
  return (static_cast<long long>(bytes[0]) << 24) | (bytes[1] << 16) | (bytes[2] << 8) | bytes[3];
}

/// What stb makes of the bytes of a file, of the format `kind`.
Image decode(const std::filesystem::path& path, const std::string& bytes, const char* kind) {
  const auto* data = reinterpret_cast<const stbi_uc*>(bytes.data());
  const auto fail = [&] {
    return Error("{}: cannot be read as a {} picture, it is truncated or damaged: {}", path.string(), kind,
                 stbi_failure_reason());
  };
  // stb counts bytes in int.
  if (bytes.size() > INT32_MAX) throw Error("{}: expected a {} file under 2 GiB", path.string(), kind);
  const int size = static_cast<int>(bytes.size());
  int width = 0, height = 0, channels = 0;
  if (!stbi_info_from_memory(data, size, &width, &height, &channels)) throw fail();
  require_sane_size(path, width, height, channels);

  if (stbi_is_16_bit_from_memory(data, size)) {
    const std::unique_ptr<stbi_us, FreePixels> pixels(
        stbi_load_16_from_memory(data, size, &width, &height, &channels, 0));
    if (!pixels) throw fail();
    return to_linear(pixels.get(), width, height, channels, 65535);
  }
  const std::unique_ptr<stbi_uc, FreePixels> pixels(stbi_load_from_memory(data, size, &width, &height, &channels, 0));
  if (!pixels) throw fail();
  return to_linear(pixels.get(), width, height, channels, 255);
}

}  // namespace

Image read_png(const std::filesystem::path& path) {
  const std::string bytes = read_file(path);
  constexpr std::string_view kSignature = "\x89PNG\r\n\x1a\n";
  if (!bytes.starts_with(kSignature)) throw Error("{}: expected a PNG picture, found something else", path.string());
  // The header stands first: 8 bytes of signature, 8 of chunk, then width and height.
  if (bytes.size() < 24) throw Error("{}: the file is truncated", path.string());
  const auto* data = reinterpret_cast<const stbi_uc*>(bytes.data());
  require_sane_size(path, read_big_endian(data + 16), read_big_endian(data + 20), 1);
  return decode(path, bytes, "PNG");
}

Image read_jpeg(const std::filesystem::path& path) {
  const std::string bytes = read_file(path);
  constexpr std::string_view kBegin = "\xff\xd8\xff", kEnd = "\xff\xd9";
  if (!bytes.starts_with(kBegin)) throw Error("{}: expected a JPEG picture, found something else", path.string());
  // stb paints what is missing grey. Some cameras write a little behind the end.
  constexpr std::size_t kMostBehind = 1024;
  const std::size_t end = bytes.rfind(kEnd);
  if (end == std::string::npos || end + kMostBehind < bytes.size())
    throw Error("{}: the file is truncated", path.string());
  return decode(path, bytes, "JPEG");
}

std::string encode_png(const Image& image) {
  if (image.channels > 4) throw Error("expected 1 to 4 channels in a PNG, found {}", image.channels);
  std::vector<std::uint8_t> stored(image.data.size());
  for (std::size_t i = 0; i < stored.size(); ++i) {
    const float value = std::isnan(image.data[i]) ? 0 : std::clamp(image.data[i], 0.0f, 1.0f);
    const bool alpha = is_alpha(static_cast<int>(i % image.channels), image.channels);
    stored[i] = static_cast<std::uint8_t>(std::lround(255 * (alpha ? value : linear_to_srgb(value))));
  }
  std::string bytes;
  const auto append = [](void* context, void* data, int count) {
    static_cast<std::string*>(context)->append(static_cast<const char*>(data), static_cast<std::size_t>(count));
  };
  if (!stbi_write_png_to_func(append, &bytes, image.width, image.height, image.channels, stored.data(),
                              image.width * image.channels))
    throw Error("a picture of {} x {} pixels cannot be compressed as a PNG", image.width, image.height);
  return bytes;
}

void write_png(const Image& image, const std::filesystem::path& path) {
  std::string bytes;
  try {
    bytes = encode_png(image);
  } catch (const Error& error) {
    throw Error("{}: {}", path.string(), error.what());
  }
  write_file(path, bytes);
}

}  // namespace redmap
