#include "map/map_file.h"

#include <Imath/half.h>
#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfMultiPartInputFile.h>
#include <OpenEXR/ImfMultiPartOutputFile.h>
#include <OpenEXR/ImfPartType.h>
#include <OpenEXR/ImfStandardAttributes.h>
#include <OpenEXR/ImfStringAttribute.h>
#include <OpenEXR/ImfTileDescriptionAttribute.h>
#include <OpenEXR/ImfTiledInputPart.h>
#include <OpenEXR/ImfTiledOutputPart.h>

#include <algorithm>
#include <cmath>

#include "base/atomic_file.h"
#include "base/error.h"
#include "base/exr_header.h"
#include "base/exr_stream.h"
#include "map/map_description.h"
#include "map/map_file_clusters.h"
#include "map/map_file_normals.h"
#include "map/tangent_moments.h"

namespace redmap {
namespace {

constexpr const char* kAttribute = "redmap";
constexpr unsigned kTileSize = 64;  ///< what texture systems like best
/// Twice and once the largest size of a bake.
constexpr int kMaxWidth = 32768, kMaxHeight = 16384;

/// Parts of the file: the weights, a channel a basis reflectance, and the coverage, which viewers show as a grey
/// picture. Tangents, normals and clusters follow, in this order, where there are any.
enum Part { kWeights, kCoverage, kTangents };
constexpr const char* kPartNames[] = {"weights", "coverage", "tangents"};
constexpr int kFewestParts = 2, kMostParts = 5;

/// Readers order channels by name, so the names carry the order.
std::string channel_name(Part part, int channel) {
  if (part == kTangents) return channel == 0 ? "cosine" : "sine";
  return part == kCoverage ? "Y" : fmt::format("basis{:02}", channel);
}
int channel_count(Part part, const WeightPyramid& texels) { return part == kCoverage ? 1 : texels.channels(); }
/// Where channel 0 of a part is in a texel.
int first_component(Part part) { return part == kCoverage ? 0 : 1; }

const WeightPyramid& texels_of(const ReductionMap& map, Part part) {
  return part == kTangents ? map.tangents : map.weights;
}

Imf::Header make_header(const ReductionMap& map, Part part) {
  const Extent extent = map.weights.extent(0);
  Imf::Header header(extent.width, extent.height);
  header.setName(kPartNames[part]);
  header.setType(Imf::TILEDIMAGE);
  header.compression() = Imf::ZIP_COMPRESSION;
  header.setTileDescription(Imf::TileDescription(kTileSize, kTileSize, Imf::MIPMAP_LEVELS, Imf::ROUND_DOWN));
  Imf::addWrapmodes(header, map.weights.wraps_u() ? "periodic,clamp" : "clamp,clamp");
  if (part == kWeights) header.insert(kAttribute, Imf::StringAttribute(describe_map(map)));
  for (int c = 0; c < channel_count(part, texels_of(map, part)); ++c)
    header.channels().insert(channel_name(part, c), Imf::Channel(Imf::HALF));
  return header;
}

/// A row of tiles of one level, channels interleaved, as OpenEXR reads and writes it.
struct Band {
  int first_row, rows, width, channels;
  std::vector<half> values;

  Band(Extent extent, int band, int channel_total)
      : first_row(band * static_cast<int>(kTileSize)),
        rows(std::min(static_cast<int>(kTileSize), extent.height - first_row)),
        width(extent.width),
        channels(channel_total),
        values(static_cast<std::size_t>(rows) * width * channels) {}

  Imf::FrameBuffer frame_buffer(Part part) {
    Imf::FrameBuffer buffer;
    const std::size_t texel = channels * sizeof(half), row = texel * width;
    char* origin = reinterpret_cast<char*>(values.data()) - static_cast<std::ptrdiff_t>(first_row * row);
    for (int c = 0; c < channels; ++c)
      buffer.insert(channel_name(part, c), Imf::Slice(Imf::HALF, origin + c * sizeof(half), texel, row));
    return buffer;
  }
};

void write_part(Imf::MultiPartOutputFile& file, Part part, const WeightPyramid& texels) {
  Imf::TiledOutputPart out(file, part);
  const int stride = texels.texel_stride();
  for (int level = 0; level < texels.levels(); ++level)
    for (int b = 0; b < out.numYTiles(level); ++b) {
      Band band(texels.extent(level), b, channel_count(part, texels));
      half* value = band.values.data();
      for (int y = band.first_row; y < band.first_row + band.rows; ++y) {
        const auto row = texels.row(level, y);
        for (int x = 0; x < band.width; ++x)
          for (int c = 0; c < band.channels; ++c)
            // Eleven bits tell 256 values apart: a byte comes back exactly.
            *value++ = half(static_cast<float>(row[x * stride + first_component(part) + c]) / 255.0f);
      }
      out.setFrameBuffer(band.frame_buffer(part));
      out.writeTiles(0, out.numXTiles(level) - 1, b, b, level);
    }
}

std::uint8_t byte_of(half value, const std::string& where) {
  const float scaled = 255.0f * static_cast<float>(value);
  const float nearest = std::round(scaled);
  if (!(nearest >= 0 && nearest <= 255 && std::abs(scaled - nearest) < 0.1f))
    throw Error("{}: expected texels of 0 to 1 in steps of 1/255, found {}", where, static_cast<float>(value));
  return static_cast<std::uint8_t>(nearest);
}

void read_part(Imf::MultiPartInputFile& file, Part part, const std::string& where, WeightPyramid& texels) {
  Imf::TiledInputPart in(file, part);
  const int stride = texels.texel_stride();
  for (int level = 0; level < texels.levels(); ++level)
    for (int b = 0; b < in.numYTiles(level); ++b) {
      Band band(texels.extent(level), b, channel_count(part, texels));
      in.setFrameBuffer(band.frame_buffer(part));
      in.readTiles(0, in.numXTiles(level) - 1, b, b, level);
      const half* value = band.values.data();
      for (int y = band.first_row; y < band.first_row + band.rows; ++y) {
        const auto row = texels.row(level, y);
        for (int x = 0; x < band.width; ++x)
          for (int c = 0; c < band.channels; ++c)
            row[x * stride + first_component(part) + c] = byte_of(*value++, where);
      }
    }
}

/// Throws unless the part is what make_header() makes.
void check_header(const Imf::Header& header, Part part, int channels, Extent extent, const std::string& where) {
  const Imath::Box2i& window = header.dataWindow();
  if (window.min != Imath::V2i(0, 0) || window.max != Imath::V2i(extent.width - 1, extent.height - 1))
    throw Error("{}: part {}: expected {}x{} texels like the other part", where, kPartNames[part], extent.width,
                extent.height);
  const bool tiled = header.hasTileDescription();
  if (!tiled || header.tileDescription().mode != Imf::MIPMAP_LEVELS ||
      header.tileDescription().roundingMode != Imf::ROUND_DOWN || header.tileDescription().ySize != kTileSize)
    throw Error("{}: part {}: expected mip-mapped tiles of {} texels, found {}", where, kPartNames[part], kTileSize,
                tiled ? "others" : "no tiles");
  int found = 0;
  for (auto channel = header.channels().begin(); channel != header.channels().end(); ++channel, ++found)
    if (found >= channels || channel_name(part, found) != channel.name() || channel.channel().type != Imf::HALF)
      throw Error("{}: part {}: expected {} half channels from \"{}\", found \"{}\"", where, kPartNames[part], channels,
                  channel_name(part, 0), channel.name());
  if (found != channels)
    throw Error("{}: part {}: expected {} channels, found {}", where, kPartNames[part], channels, found);
}

Extent checked_extent(const Imf::Header& header, const std::string& where) {
  const Imath::Box2i& window = header.dataWindow();
  const double width = 1.0 + window.max.x - window.min.x, height = 1.0 + window.max.y - window.min.y;
  if (!(width >= 1 && width <= kMaxWidth && height >= 1 && height <= kMaxHeight))
    throw Error("{}: expected 1x1 to {}x{} texels, found {}x{}", where, kMaxWidth, kMaxHeight, width, height);
  return {static_cast<int>(width), static_cast<int>(height)};
}

/// The tangents' texels are covered as the weights' are.
WeightPyramid read_tangents(Imf::MultiPartInputFile& file, const MapDescription& description,
                            const std::string& where) {
  const WeightPyramid& weights = description.map.weights;
  if (description.tangent_scales.size() != TangentMoments::kCount)
    throw Error("{}: tangent_scales: expected {} numbers beside the part \"tangents\", found {}", where,
                TangentMoments::kCount, description.tangent_scales.size());
  WeightPyramid tangents(weights.extent(0), TangentMoments::kCount, weights.wraps_u(), description.tangent_scales);
  read_part(file, kTangents, where, tangents);
  for (int level = 0; level < tangents.levels(); ++level)
    for (int y = 0; y < tangents.extent(level).height; ++y) {
      const auto from = weights.row(level, y);
      const auto to = tangents.row(level, y);
      const std::size_t width = tangents.extent(level).width;
      for (std::size_t x = 0; x < width; ++x) to[x * tangents.texel_stride()] = from[x * weights.texel_stride()];
    }
  tangents.pad_rows();
  return tangents;
}

ReductionMap read_open_file(Imf::MultiPartInputFile& file, const std::string& where) {
  if (file.parts() < kFewestParts || file.parts() > kMostParts)
    throw Error("{}: expected {} to {} parts, found {}", where, kFewestParts, kMostParts, file.parts());
  const auto* attribute = file.header(kWeights).findTypedAttribute<Imf::StringAttribute>(kAttribute);
  if (!attribute)
    throw Error("{}: expected a reduction map, found a picture without the attribute \"{}\"", where, kAttribute);
  MapDescription description = parse_map_description(attribute->value(), where);

  // All is checked before anything large is allocated.
  const Extent extent = checked_extent(file.header(kWeights), where);
  std::vector<Part> parts{kWeights, kCoverage};
  if (file.parts() > kTangents && file.header(kTangents).name() == kPartNames[kTangents]) parts.push_back(kTangents);
  for (Part part : parts) {
    const int basis = static_cast<int>(description.map.basis.size());
    const int channels = part == kCoverage ? 1 : part == kTangents ? TangentMoments::kCount : basis;
    check_header(file.header(part), part, channels, extent, where);
    if (!file.partComplete(part))
      throw Error("{}: part {}: expected all tiles, found a truncated file", where, kPartNames[part]);
  }
  description.map.weights =
      WeightPyramid(extent, static_cast<int>(description.scales.size()), description.wraps_u, description.scales);
  for (Part part : {kWeights, kCoverage}) read_part(file, part, where, description.map.weights);
  description.map.weights.pad_rows();
  if (parts.size() > kTangents) description.map.tangents = read_tangents(file, description, where);
  int next = static_cast<int>(parts.size());
  if (next < file.parts() && file.header(next).name() == kNormalsPart)
    description.map.normals = read_normals(file, next++, description.map.weights, where);
  if (next < file.parts())
    description.map.clusters = read_clusters(file, next++, description.map.weights.channels(), where);
  if (next < file.parts())
    throw Error("{}: expected no part after \"{}\", found \"{}\"", where, file.header(next - 1).name(),
                file.header(next).name());
  return std::move(description.map);
}

std::string one_line(std::string text) {
  std::replace(text.begin(), text.end(), '\n', ' ');
  return text;
}

}  // namespace

void write_map(const std::filesystem::path& path, const ReductionMap& map) {
  ExrMemoryStream stream(path.string());
  try {
    std::vector<Imf::Header> headers{make_header(map, kWeights), make_header(map, kCoverage)};
    if (!map.tangents.empty()) headers.push_back(make_header(map, kTangents));
    if (!map.normals.empty()) headers.push_back(make_normals_header(map.weights));
    if (!map.clusters.empty()) headers.push_back(make_clusters_header(map.clusters, map.weights.extent(0)));
    Imf::MultiPartOutputFile file(stream, headers.data(), static_cast<int>(headers.size()));
    for (Part part : {kWeights, kCoverage}) write_part(file, part, map.weights);
    if (!map.tangents.empty()) write_part(file, kTangents, map.tangents);
    int next = map.tangents.empty() ? kTangents : kTangents + 1;
    if (!map.normals.empty()) write_normals(file, next++, map.normals);
    if (!map.clusters.empty()) write_clusters(file, next, map.clusters);
  } catch (const Error&) {
    throw;
  } catch (const std::exception& e) {
    throw Error("{}: cannot write the map: {}", path.string(), one_line(e.what()));
  }
  write_file(path, stream.bytes());
}

ReductionMap read_map(const std::filesystem::path& path) {
  const std::string where = path.string();
  if (!std::filesystem::exists(path)) throw Error("{}: expected a reduction map, found no such file", where);
  try {
    require_sane_exr_header(path);
    Imf::MultiPartInputFile file(where.c_str(), Imf::globalThreadCount(), false);
    return read_open_file(file, where);
  } catch (const Error&) {
    throw;
  } catch (const std::exception& e) {
    throw Error("{}: expected a reduction map, found a file that OpenEXR cannot read: {}", where, one_line(e.what()));
  }
}

}  // namespace redmap
