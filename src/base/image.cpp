// Pictures of linear floats: what all file formats have in common.
#include "base/image.h"

#include "base/error.h"
#include "base/image_files.h"

namespace redmap {

void require_sane_size(const std::filesystem::path& path, long long width, long long height, long long channels) {
  // 2^29 values are 2 GiB of floats, an RGBA picture of 11 585 pixels squared.
  constexpr long long kMaxValues = 1LL << 29, kMaxSide = 1LL << 24;
  const bool sides_ok = width > 0 && height > 0 && width <= kMaxSide && height <= kMaxSide;
  if (!sides_ok || channels < 1 || width * height > kMaxValues / channels)
    throw Error("{}: expected a picture of at most {} values, found {} x {} pixels of {} channels", path.string(),
                kMaxValues, width, height, channels);
}

std::vector<std::string> channel_names_of(const Image& image, const std::filesystem::path& path) {
  if (image.channel_names.size() == static_cast<std::size_t>(image.channels)) return image.channel_names;
  switch (image.channels) {
    case 1:
      return {"Y"};
    case 2:
      return {"Y", "A"};
    case 3:
      return {"R", "G", "B"};
    case 4:
      return {"R", "G", "B", "A"};
    default:
      throw Error("{}: expected a name for each of {} channels, found {} names", path.string(), image.channels,
                  image.channel_names.size());
  }
}

Image read_image(const std::filesystem::path& path) {
  if (!std::filesystem::exists(path)) throw Error("{}: no such picture", path.string());
  if (path.extension() == ".exr") return read_exr(path);
  if (path.extension() == ".png") return read_png(path);
  if (path.extension() == ".jpg" || path.extension() == ".jpeg") return read_jpeg(path);
  throw Error("{}: expected a picture that ends in .exr, .png or .jpg", path.string());
}

void write_image(const Image& image, const std::filesystem::path& path, ExrPrecision precision) {
  require_sane_size(path, image.width, image.height, image.channels);
  if (image.data.size() != image.pixels() * static_cast<std::size_t>(image.channels))
    throw Error("{}: expected {} x {} x {} values to write, found {}", path.string(), image.width, image.height,
                image.channels, image.data.size());
  if (path.extension() == ".exr") return write_exr(image, path, precision);
  if (path.extension() == ".png") return write_png(image, path);
  throw Error("{}: expected a picture name that ends in .exr or .png", path.string());
}

}  // namespace redmap
