// OpenEXR pictures: the first part of any scan line or tiled file in, scan lines out.
#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfInputFile.h>
#include <OpenEXR/ImfOutputFile.h>

#include <algorithm>
#include <cmath>
#include <cstring>

#include "base/atomic_file.h"
#include "base/error.h"
#include "base/exr_header.h"
#include "base/exr_stream.h"
#include "base/image_files.h"

namespace redmap {

namespace {

constexpr float kMaxHalf = 65504;

/// The channels of the file that make the picture, in the picture's order; `standard` if they need no names.
std::vector<std::string> choose_channels(const Imf::ChannelList& list, bool& standard) {
  const auto has = [&](const char* name) { return list.findChannel(name) != nullptr; };
  standard = true;
  std::vector<std::string> names;
  if (has("R") && has("G") && has("B")) {
    names = {"R", "G", "B"};
  } else if (has("Y")) {
    names = {"Y"};
  } else {
    standard = false;
    for (auto channel = list.begin(); channel != list.end(); ++channel) names.emplace_back(channel.name());
    return names;
  }
  if (has("A")) names.emplace_back("A");
  return names;
}

/// Subsampled chroma would need the reconstruction of OpenEXR's luminance-chroma pictures.
void require_full_resolution(const std::filesystem::path& path, const Imf::ChannelList& list,
                             const std::vector<std::string>& names) {
  const bool luminance_chroma = list.findChannel("RY") != nullptr || list.findChannel("BY") != nullptr;
  const bool subsampled = std::any_of(names.begin(), names.end(), [&](const std::string& name) {
    return list[name].xSampling != 1 || list[name].ySampling != 1;
  });
  if (luminance_chroma || subsampled)
    throw Error("{}: expected channels at full resolution, found luminance and subsampled chroma", path.string());
}

Image read_open_file(const std::filesystem::path& path, Imf::InputFile& file) {
  const Imath::Box2i window = file.header().dataWindow();
  const Imf::ChannelList& list = file.header().channels();
  bool standard = false;
  const std::vector<std::string> names = choose_channels(list, standard);
  const long long width = 1LL + window.max.x - window.min.x, height = 1LL + window.max.y - window.min.y;
  require_sane_size(path, width, height, static_cast<long long>(names.size()));
  require_full_resolution(path, list, names);
  if (!file.isComplete()) throw Error("{}: the file is truncated", path.string());

  Image image(static_cast<int>(width), static_cast<int>(height), static_cast<int>(names.size()));
  if (!standard) image.channel_names = names;
  Imf::FrameBuffer frame;
  const std::size_t pixel_bytes = sizeof(float) * names.size();
  for (std::size_t c = 0; c < names.size(); ++c)
    frame.insert(names[c], Imf::Slice::Make(Imf::FLOAT, image.data.data() + c, window, pixel_bytes,
                                            pixel_bytes * static_cast<std::size_t>(width)));
  file.setFrameBuffer(frame);
  file.readPixels(window.min.y, window.max.y);
  return image;
}

/// `image` as halves, clamped so that no finite value becomes infinite.
std::vector<half> to_half(const Image& image) {
  std::vector<half> halves(image.data.size());
  std::transform(image.data.begin(), image.data.end(), halves.begin(),
                 [](float v) { return half(std::isfinite(v) ? std::clamp(v, -kMaxHalf, kMaxHalf) : v); });
  return halves;
}

}  // namespace

Image read_exr(const std::filesystem::path& path) {
  try {
    require_sane_exr_header(path);
    Imf::InputFile file(path.c_str());
    return read_open_file(path, file);
  } catch (const Error&) {
    throw;
  } catch (const std::exception& error) {
    throw Error("{}: cannot be read as an OpenEXR picture, it is truncated or damaged: {}", path.string(),
                error.what());
  }
}

void write_exr(const Image& image, const std::filesystem::path& path, ExrPrecision precision) {
  const std::vector<std::string> names = channel_names_of(image, path);
  const bool is_half = precision == ExrPrecision::kHalf;
  const std::vector<half> halves = is_half ? to_half(image) : std::vector<half>();
  const Imf::PixelType type = is_half ? Imf::HALF : Imf::FLOAT;
  const char* first =
      is_half ? reinterpret_cast<const char*>(halves.data()) : reinterpret_cast<const char*>(image.data.data());
  const std::size_t value_bytes = is_half ? sizeof(half) : sizeof(float), pixel_bytes = value_bytes * names.size();

  Imf::Header header(image.width, image.height);
  header.compression() = Imf::ZIP_COMPRESSION;
  Imf::FrameBuffer frame;
  for (std::size_t c = 0; c < names.size(); ++c) {
    header.channels().insert(names[c], Imf::Channel(type));
    // OpenEXR takes a mutable pointer for reading and writing alike; here it only reads.
    char* base = const_cast<char*>(first) + c * value_bytes;
    frame.insert(names[c], Imf::Slice(type, base, pixel_bytes, pixel_bytes * static_cast<std::size_t>(image.width)));
  }
  ExrMemoryStream stream(path.string());
  try {
    Imf::OutputFile file(stream, header);
    file.setFrameBuffer(frame);
    file.writePixels(image.height);
  } catch (const std::exception& error) {
    throw Error("{}: cannot be written as an OpenEXR picture: {}", path.string(), error.what());
  }
  write_file(path, stream.bytes());
}

}  // namespace redmap
