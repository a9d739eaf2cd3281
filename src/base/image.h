// Pictures of linear floats and their files: OpenEXR as it is, PNG through the sRGB transfer function.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "base/vec.h"

namespace redmap {

/// `width` x `height` pixels, row by row from the top left, `channels` floats each. Colour is linear light.
struct Image {
  int width = 0, height = 0, channels = 0;
  std::vector<float> data;
  std::vector<std::string> channel_names;  ///< empty: Y, YA, RGB or RGBA by their number

  Image() = default;
  Image(int width_pixels, int height_pixels, int channel_count, float value = 0)
      : width(width_pixels),
        height(height_pixels),
        channels(channel_count),
        data(pixels() * static_cast<std::size_t>(channel_count), value) {}

  std::size_t pixels() const { return static_cast<std::size_t>(width) * static_cast<std::size_t>(height); }
  float& at(int x, int y, int channel) { return data[index(x, y, channel)]; }
  float at(int x, int y, int channel) const { return data[index(x, y, channel)]; }
  /// Colour of pixel (x, y); pictures with fewer than three channels are grey.
  Rgb rgb(int x, int y) const {
    const std::size_t i = index(x, y, 0);
    return channels >= 3 ? Rgb{data[i], data[i + 1], data[i + 2]} : Rgb{data[i], data[i], data[i]};
  }
  void set_rgb(int x, int y, Rgb c) {
    const std::size_t i = index(x, y, 0);
    data[i] = c.r, data[i + 1] = c.g, data[i + 2] = c.b;
  }

 private:
  std::size_t index(int x, int y, int channel) const {
    return (static_cast<std::size_t>(y) * width + x) * channels + channel;
  }
};

/// How floats are stored in an OpenEXR file, always with lossless ZIP compression.
enum class ExrPrecision {
  kHalf,  ///< 16 bits; finite values are clamped to the largest half, 65504
  kFloat
};

/// Reads `path` by its extension. `.exr`: the data window of the first part, finest level, scan lines or tiles;
/// channels R, G, B and A where there is an R, G or B, else Y and A, else all of them with their names. `.png`: 8 or 16
/// bits, `.jpg` and `.jpeg`: 8; colour to linear light, alpha as it is. Throws Error on a missing, truncated, damaged,
/// unsupported or absurdly large file (over 2^29 values).
Image read_image(const std::filesystem::path& path);

/// Writes `path` by its extension, atomically. `.png`: 1 to 4 channels, 8 bits, clamped to [0, 1], NaN as 0, no
/// dithering; `precision` concerns only `.exr`. Throws Error on an unknown extension, on a picture that is empty or
/// whose channels have no names, and when the file cannot be written whole.
void write_image(const Image& image, const std::filesystem::path& path, ExrPrecision precision = ExrPrecision::kFloat);

/// The bytes of the PNG file that write_image() writes. Throws Error on more than four channels, and on no pixels.
std::string encode_png(const Image& image);

}  // namespace redmap
