// One pixel a leaf, in rows of up to 512, floats.
#include "map/map_file_clusters.h"

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfPartType.h>
#include <OpenEXR/ImfTileDescriptionAttribute.h>
#include <OpenEXR/ImfTiledInputPart.h>
#include <OpenEXR/ImfTiledOutputPart.h>

#include <algorithm>
#include <bit>
#include <cmath>

#include "base/error.h"

namespace redmap {
namespace {

constexpr const char* kPartName = "clusters";
constexpr unsigned kTileSize = 64;
constexpr int kRow = 512;
/// More than a bake makes.
constexpr int kMostRows = (1 << 20) / kRow;

/// What is stored of a place, in this order; the weights follow.
constexpr const char* kPlaceChannels[] = {"P.x", "P.y", "P.z", "N.x", "N.y", "N.z", "radius", "variance"};
constexpr int kPlaceFloats = 8;
static_assert(sizeof(ClusterPlace) == kPlaceFloats * sizeof(float));

std::string channel_name(int channel) {
  return channel < kPlaceFloats ? kPlaceChannels[channel] : fmt::format("basis{:02}", channel - kPlaceFloats);
}

/// All leaves, channels interleaved.
struct LeafPixels {
  int width, height, channels;
  std::vector<float> values;

  LeafPixels(int columns, int rows, int weights)
      : width(columns),
        height(rows),
        channels(kPlaceFloats + weights),
        values(std::size_t(width) * height * channels) {}

  float* leaf(std::size_t i) { return values.data() + i * channels; }
  Imf::FrameBuffer frame_buffer() {
    Imf::FrameBuffer buffer;
    const std::size_t pixel = channels * sizeof(float);
    for (int c = 0; c < channels; ++c)
      buffer.insert(channel_name(c),
                    Imf::Slice(Imf::FLOAT, reinterpret_cast<char*>(values.data() + c), pixel, pixel * width));
    return buffer;
  }
};

void check_channels(const Imf::Header& header, int channels, const std::string& where) {
  int found = 0;
  for (auto channel = header.channels().begin(); channel != header.channels().end(); ++channel) ++found;
  for (int c = 0; c < channels; ++c) {
    const Imf::Channel* channel = header.channels().findChannel(channel_name(c));
    if (found != channels || !channel || channel->type != Imf::FLOAT)
      throw Error("{}: part {}: expected {} float channels with \"{}\", found {} channels", where, kPartName, channels,
                  channel_name(c), found);
  }
}

}  // namespace

Imf::Header make_clusters_header(const SurfaceClusters& clusters, Extent extent) {
  const int leaves = static_cast<int>(clusters.leaves()), width = std::min(kRow, leaves);
  Imf::Header header(extent.width, extent.height);
  header.dataWindow() = {{0, 0}, {width - 1, leaves / width - 1}};
  header.setName(kPartName);
  header.setType(Imf::TILEDIMAGE);
  header.compression() = Imf::ZIP_COMPRESSION;
  header.setTileDescription(Imf::TileDescription(kTileSize, kTileSize, Imf::ONE_LEVEL));
  for (int c = 0; c < kPlaceFloats + clusters.channels(); ++c)
    header.channels().insert(channel_name(c), Imf::Channel(Imf::FLOAT));
  return header;
}

void write_clusters(Imf::MultiPartOutputFile& file, int part, const SurfaceClusters& clusters) {
  const int leaves = static_cast<int>(clusters.leaves()), width = std::min(kRow, leaves);
  LeafPixels pixels(width, leaves / width, clusters.channels());
  for (int i = 0; i < leaves; ++i) {
    const auto [position, normal, radius, variance] = clusters.leaf(i);
    const float place[] = {position.x, position.y, position.z, normal.x, normal.y, normal.z, radius, variance};
    std::copy(std::begin(place), std::end(place), pixels.leaf(i));
    const std::vector<float> weights = clusters.leaf_weights(i);
    std::copy(weights.begin(), weights.end(), pixels.leaf(i) + kPlaceFloats);
  }
  Imf::TiledOutputPart out(file, part);
  out.setFrameBuffer(pixels.frame_buffer());
  out.writeTiles(0, out.numXTiles() - 1, 0, out.numYTiles() - 1);
}

SurfaceClusters read_clusters(Imf::MultiPartInputFile& file, int part, int channels, const std::string& where) {
  const Imf::Header& header = file.header(part);
  const Imath::Box2i window = header.dataWindow();
  const double width = 1.0 + window.max.x, height = 1.0 + window.max.y;
  if (header.name() != kPartName || !header.hasTileDescription() || header.tileDescription().mode != Imf::ONE_LEVEL)
    throw Error("{}: expected a part \"{}\" of tiles, found \"{}\"", where, kPartName, header.name());
  if (window.min != Imath::V2i(0, 0) || !(width >= 1 && width <= kRow && height >= 1 && height <= kMostRows))
    throw Error("{}: part {}: expected up to {}x{} leaves, found {}x{}", where, kPartName, kRow, kMostRows, width,
                height);
  check_channels(header, kPlaceFloats + channels, where);
  if (!file.partComplete(part))
    throw Error("{}: part {}: expected all tiles, found a truncated file", where, kPartName);

  LeafPixels pixels(static_cast<int>(width), static_cast<int>(height), channels);
  Imf::TiledInputPart in(file, part);
  in.setFrameBuffer(pixels.frame_buffer());
  in.readTiles(0, in.numXTiles() - 1, 0, in.numYTiles() - 1);
  const std::size_t leaves = std::size_t(pixels.width) * pixels.height;
  std::vector<ClusterPlace> places(leaves);
  std::vector<float> weights;
  for (std::size_t i = 0; i < leaves; ++i) {
    const float* p = pixels.leaf(i);
    places[i] = {{p[0], p[1], p[2]}, {p[3], p[4], p[5]}, p[6], p[7]};
    weights.insert(weights.end(), p + kPlaceFloats, p + pixels.channels);
  }
  try {
    return SurfaceClusters(std::move(places), std::move(weights), channels);
  } catch (const Error& error) {
    throw Error("{}: part {}: {}", where, kPartName, error.what());
  }
}

}  // namespace redmap
