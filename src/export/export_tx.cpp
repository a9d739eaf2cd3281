// Tiled, mip-mapped TIFF for texture systems (OpenImageIO reads it), as `maketx` writes it, except that every level is
// the map's own: averaging an averaged material again would be another material.
#include <fmt/format.h>
#include <tiffio.h>

#include <algorithm>
#include <cstdarg>
#include <cstdio>
#include <memory>

#include "base/error.h"
#include "export/export.h"
#include "export/manifest.h"

namespace redmap {

namespace {

constexpr int kTile = 64;          // maketx's default
constexpr int kExifColorSrgb = 1;  // EXIF 2.3, ColorSpace

/// A TIFF file that is written level by level, what libtiff says of it kept instead of printed.
class TiffFile {
 public:
  TiffFile(std::string name, const std::string& path) : name_(std::move(name)) {
    const std::unique_ptr<TIFFOpenOptions, void (*)(TIFFOpenOptions*)> options(TIFFOpenOptionsAlloc(),
                                                                               TIFFOpenOptionsFree);
    TIFFOpenOptionsSetErrorHandlerExtR(options.get(), keep_message, &message_);
    file_.reset(TIFFOpenExt(path.c_str(), "w", options.get()));
    require(file_ != nullptr);
  }

  template <typename... Values>
  void set(std::uint32_t tag, Values... values) {
    require(TIFFSetField(file_.get(), tag, values...) == 1);
  }

  /// Where a directory lies that says that colours are in sRGB: to be set as the first level's TIFFTAG_EXIFIFD.
  std::uint64_t write_srgb() {
    std::uint64_t offset = 0;
    require(TIFFCreateEXIFDirectory(file_.get()) == 0);
    set(EXIFTAG_COLORSPACE, kExifColorSrgb);
    require(TIFFWriteCustomDirectory(file_.get(), &offset) == 1);
    TIFFFreeDirectory(file_.get());  // TIFFCreateDirectory() would leak it
    require(TIFFCreateDirectory(file_.get()) == 0);
    return offset;
  }

  /// `level` in tiles, what reaches beyond it zero, and the directory of all that was set.
  void write(const TextureLevel& level, int channels) {
    std::vector<std::uint8_t> tile(static_cast<std::size_t>(kTile) * kTile * channels);
    for (int top = 0; top < level.extent.height; top += kTile)
      for (int left = 0; left < level.extent.width; left += kTile) {
        const int columns = std::min(kTile, level.extent.width - left),
                  rows = std::min(kTile, level.extent.height - top);
        std::ranges::fill(tile, std::uint8_t{0});
        for (int y = 0; y < rows; ++y)
          std::copy_n(level.texel(left, top + y, channels), static_cast<std::size_t>(columns) * channels,
                      &tile[static_cast<std::size_t>(y) * kTile * channels]);
        require(TIFFWriteTile(file_.get(), tile.data(), left, top, 0, 0) >= 0);
      }
    require(TIFFWriteDirectory(file_.get()) == 1);
  }

 private:
  static int keep_message(TIFF*, void* message, const char*, const char* format, va_list values) {
    char text[256];
    std::vsnprintf(text, sizeof text, format, values);
    *static_cast<std::string*>(message) = text;
    return 1;
  }
  void require(bool done) const {
    if (!done) throw Error("{}: cannot be written: {}", name_, message_);
  }

  std::string name_, message_;
  std::unique_ptr<TIFF, void (*)(TIFF*)> file_{nullptr, TIFFClose};
};

/// Means of the channels over the coarsest level, as maketx leaves them for texture systems.
std::string average_color(const Texture& texture) {
  const TextureLevel& last = texture.levels.back();
  std::string text;
  for (int c = 0; c < texture.channels; ++c)
    text += fmt::format("{}{:g}", c ? "," : "", static_cast<float>(*(last.texel(0, 0, texture.channels) + c)) / 255);
  return text;
}

void set_layout(const Texture& texture, const Extent& extent, TiffFile& file) {
  file.set(TIFFTAG_IMAGEWIDTH, extent.width);
  file.set(TIFFTAG_IMAGELENGTH, extent.height);
  file.set(TIFFTAG_TILEWIDTH, kTile);
  file.set(TIFFTAG_TILELENGTH, kTile);
  file.set(TIFFTAG_SAMPLESPERPIXEL, texture.channels);
  file.set(TIFFTAG_BITSPERSAMPLE, 8);
  file.set(TIFFTAG_SAMPLEFORMAT, SAMPLEFORMAT_UINT);
  file.set(TIFFTAG_PHOTOMETRIC, texture.channels < 3 ? PHOTOMETRIC_MINISBLACK : PHOTOMETRIC_RGB);
  file.set(TIFFTAG_PLANARCONFIG, PLANARCONFIG_CONTIG);
  file.set(TIFFTAG_ORIENTATION, ORIENTATION_TOPLEFT);
  file.set(TIFFTAG_COMPRESSION, COMPRESSION_ADOBE_DEFLATE);
  file.set(TIFFTAG_PREDICTOR, PREDICTOR_HORIZONTAL);
}

/// What texture systems want to know, under the names that maketx gives it.
void set_meaning(const Texture& texture, TiffFile& file) {
  file.set(TIFFTAG_PIXAR_TEXTUREFORMAT, "Plain Texture");
  file.set(TIFFTAG_PIXAR_WRAPMODES, texture.wraps_u ? "periodic,clamp" : "clamp,clamp");
  file.set(TIFFTAG_IMAGEDESCRIPTION, fmt::format("oiio:AverageColor={}", average_color(texture)).c_str());
  file.set(TIFFTAG_SOFTWARE, "redmap");
}

std::string add(const Texture& texture, ExportFolder& folder) {
  const std::string name = texture.name + ".tx";
  TiffFile file(name, folder.path_of(name).string());
  const bool is_color = texture.meaning == TexelMeaning::kColor;
  const std::uint64_t srgb = is_color ? file.write_srgb() : 0;
  for (const TextureLevel& level : texture.levels) {
    set_layout(texture, level.extent, file);
    set_meaning(texture, file);
    if (is_color) file.set(TIFFTAG_EXIFIFD, srgb);
    file.write(level, texture.channels);
  }
  return name;
}

}  // namespace

void export_tx(const ExportInput& input, ExportFolder& folder) {
  Json manifest = manifest_of(input, "tx");
  add_one_material(
      input, [&](const Texture& texture) { return add(texture, folder); }, manifest);
  const Masks masks = mask_textures(*input.map);
  manifest["masks"] = masks_json(
      masks, [&](std::size_t b, Json& mask) { mask["file"] = add(masks.textures[b], folder), mask["channel"] = 0; });
  add_manifest(manifest, folder);
}

}  // namespace redmap
