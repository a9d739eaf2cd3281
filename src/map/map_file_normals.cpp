// Halves that hold what is packed in memory: means in steps of 1/2048, all else as bytes in steps of 1/256, which
// halves tell apart.
#include "map/map_file_normals.h"

#include <Imath/half.h>
#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfPartType.h>
#include <OpenEXR/ImfTileDescriptionAttribute.h>
#include <OpenEXR/ImfTiledInputPart.h>
#include <OpenEXR/ImfTiledOutputPart.h>

#include <cmath>

#include "base/error.h"

namespace redmap {
namespace {

constexpr unsigned kTileSize = 64;
constexpr int kPackedBytes = 6;

/// Channels of one Gaussian, in this order; the weights follow.
constexpr const char* kNames[] = {"mean_x", "mean_y", "deviation_1", "deviation_2", "angle", "share"};
constexpr int kNamed = 6;

std::string channel_name(int gaussian, int channel) {
  return fmt::format("gaussian{}.{}", gaussian,
                     channel < kNamed ? kNames[channel] : fmt::format("basis{:02}", channel - kNamed));
}

/// A row of tiles of one level: channels of all Gaussians interleaved.
struct Band {
  int first_row, rows, width, channels;  ///< channels a Gaussian
  std::vector<half> values;

  Band(Extent extent, int band, int basis)
      : first_row(band * static_cast<int>(kTileSize)),
        rows(std::min(static_cast<int>(kTileSize), extent.height - first_row)),
        width(extent.width),
        channels(kNamed + basis),
        values(static_cast<std::size_t>(rows) * width * channels * NormalPyramid::kGaussians) {}

  half* gaussian(int x, int y, int g) {
    const std::size_t texel = static_cast<std::size_t>(y - first_row) * width + x;
    return &values[(texel * NormalPyramid::kGaussians + g) * channels];
  }
  Imf::FrameBuffer frame_buffer() {
    Imf::FrameBuffer buffer;
    const std::size_t size = sizeof(half) * channels * NormalPyramid::kGaussians, row = size * width;
    char* origin = reinterpret_cast<char*>(values.data()) - static_cast<std::ptrdiff_t>(first_row * row);
    for (int g = 0; g < NormalPyramid::kGaussians; ++g)
      for (int c = 0; c < channels; ++c)
        buffer.insert(channel_name(g, c), Imf::Slice(Imf::HALF, origin + sizeof(half) * (g * channels + c), size, row));
    return buffer;
  }
};

/// One Gaussian: packed normals, then share and weights, which the base does not have.
void encode(const std::uint8_t* bytes, int others, half* to) {
  const int x = bytes[0] | (bytes[1] & 15) << 8, y = bytes[1] >> 4 | bytes[2] << 4;
  // A Gaussian that is not there has no mean either.
  const bool none = x == 0 && y == 0;
  *to++ = half(none ? 0.0f : static_cast<float>(x - 2048) / 2048);
  *to++ = half(none ? 0.0f : static_cast<float>(y - 2048) / 2048);
  for (int i = 3; i < kPackedBytes + others; ++i) *to++ = half(static_cast<float>(bytes[i]) / 256);
}

int exact(half value, float steps, int low, int high, const std::string& where) {
  const float scaled = steps * static_cast<float>(value), nearest = std::round(scaled);
  if (!(nearest >= static_cast<float>(low) && nearest <= static_cast<float>(high) && scaled == nearest))
    throw Error("{}: part {}: expected {} to {} in steps of 1/{}, found {}", where, kNormalsPart, low, high, steps,
                static_cast<float>(value));
  return static_cast<int>(nearest);
}

void decode(const half* from, int others, bool present, const std::string& where, std::uint8_t* bytes) {
  const int mean_x = exact(*from++, 2048, -2047, 2047, where), mean_y = exact(*from++, 2048, -2047, 2047, where);
  const int x = present ? mean_x + 2048 : 0, y = present ? mean_y + 2048 : 0;
  bytes[0] = static_cast<std::uint8_t>(x & 255);
  bytes[1] = static_cast<std::uint8_t>(x >> 8 | (y & 15) << 4);
  bytes[2] = static_cast<std::uint8_t>(y >> 4);
  for (int i = 3; i < kPackedBytes + others; ++i)
    bytes[i] = static_cast<std::uint8_t>(exact(*from++, 256, 0, 255, where));
}

void check_header(const Imf::Header& header, const WeightPyramid& weights, const std::string& where) {
  const Imath::Box2i& window = header.dataWindow();
  const Extent extent = weights.extent(0);
  if (window.min != Imath::V2i(0, 0) || window.max != Imath::V2i(extent.width - 1, extent.height - 1))
    throw Error("{}: part {}: expected {}x{} texels like the other parts", where, kNormalsPart, extent.width,
                extent.height);
  if (!header.hasTileDescription() || header.tileDescription().mode != Imf::MIPMAP_LEVELS ||
      header.tileDescription().roundingMode != Imf::ROUND_DOWN || header.tileDescription().ySize != kTileSize)
    throw Error("{}: part {}: expected mip-mapped tiles of {} texels, found others", where, kNormalsPart, kTileSize);
  int found = 0;
  for (auto channel = header.channels().begin(); channel != header.channels().end(); ++channel) ++found;
  const int expected = NormalPyramid::kGaussians * (kNamed + weights.channels());
  for (int i = 0; i < expected; ++i) {
    const std::string name = channel_name(i / (kNamed + weights.channels()), i % (kNamed + weights.channels()));
    const Imf::Channel* channel = header.channels().findChannel(name);
    if (found != expected || !channel || channel->type != Imf::HALF)
      throw Error("{}: part {}: expected {} half channels with \"{}\", found {} channels", where, kNormalsPart,
                  expected, name, found);
  }
}

}  // namespace

Imf::Header make_normals_header(const WeightPyramid& weights) {
  const Extent extent = weights.extent(0);
  Imf::Header header(extent.width, extent.height);
  header.setName(kNormalsPart);
  header.setType(Imf::TILEDIMAGE);
  header.compression() = Imf::ZIP_COMPRESSION;
  header.setTileDescription(Imf::TileDescription(kTileSize, kTileSize, Imf::MIPMAP_LEVELS, Imf::ROUND_DOWN));
  for (int g = 0; g < NormalPyramid::kGaussians; ++g)
    for (int c = 0; c < kNamed + weights.channels(); ++c)
      header.channels().insert(channel_name(g, c), Imf::Channel(Imf::HALF));
  return header;
}

void write_normals(Imf::MultiPartOutputFile& file, int part, const NormalPyramid& normals) {
  Imf::TiledOutputPart out(file, part);
  for (int level = 0; level < normals.levels(); ++level)
    for (int b = 0; b < out.numYTiles(level); ++b) {
      Band band(normals.extent(level), b, normals.basis());
      const int others = level == 0 ? 0 : 1 + normals.basis(), gaussians = level == 0 ? 1 : NormalPyramid::kGaussians;
      for (int y = band.first_row; y < band.first_row + band.rows; ++y) {
        const std::uint8_t* bytes = normals.row(level, y).data();
        for (int x = 0; x < band.width; ++x)
          for (int g = 0; g < gaussians; ++g, bytes += kPackedBytes + others)
            encode(bytes, others, band.gaussian(x, y, g));
      }
      out.setFrameBuffer(band.frame_buffer());
      out.writeTiles(0, out.numXTiles(level) - 1, b, b, level);
    }
}

NormalPyramid read_normals(Imf::MultiPartInputFile& file, int part, const WeightPyramid& weights,
                           const std::string& where) {
  check_header(file.header(part), weights, where);
  if (!file.partComplete(part))
    throw Error("{}: part {}: expected all tiles, found a truncated file", where, kNormalsPart);
  NormalPyramid normals(weights);
  Imf::TiledInputPart in(file, part);
  for (int level = 0; level < normals.levels(); ++level)
    for (int b = 0; b < in.numYTiles(level); ++b) {
      Band band(normals.extent(level), b, normals.basis());
      in.setFrameBuffer(band.frame_buffer());
      in.readTiles(0, in.numXTiles(level) - 1, b, b, level);
      const int others = level == 0 ? 0 : 1 + normals.basis(), gaussians = level == 0 ? 1 : NormalPyramid::kGaussians;
      for (int y = band.first_row; y < band.first_row + band.rows; ++y) {
        std::uint8_t* bytes = normals.row(level, y).data();
        for (int x = 0; x < band.width; ++x)
          for (int g = 0; g < gaussians; ++g, bytes += kPackedBytes + others) {
            const half* from = band.gaussian(x, y, g);
            const bool present = level == 0 ? weights.coverage(0, x, y) > 0 : static_cast<float>(from[5]) > 0;
            decode(from, others, present, where, bytes);
          }
      }
    }
  return normals;
}

}  // namespace redmap
