#include "base/exr_header.h"

#include <cstdint>
#include <fstream>
#include <optional>
#include <string_view>
#include <utility>

#include "base/error.h"

namespace redmap {

namespace {

/// Bytes before the first attribute: magic number, version. Bit 12 of the version: several parts.
constexpr std::streamoff kStart = 8;
constexpr std::uint32_t kSeveralParts = 1u << 12;
/// Names and types have at most 255 characters and a zero.
constexpr std::streamsize kLongestName = 256;
/// The lines of one chunk, at most (DWAB compression), and what a chunk has in the table of offsets.
constexpr std::int64_t kMostLines = 256, kOffsetBytes = 8;

struct Window {
  std::int32_t x0, y0, x1, y1;
};
/// Pixels that a chunk may have in any file, and in addition for each of its bytes: twice what deflating can do.
constexpr std::int64_t kSomePixels = 1 << 24, kPixelsAByte = 2048;
/// What the sizes of a part's table of offsets and of its chunks are computed from.
struct PartSize {
  std::optional<Window> window;
  struct {
    std::uint32_t width, height;
  } tile{0, 0};
};

std::int64_t parts_of(std::int64_t whole, std::int64_t part) { return (whole + part - 1) / part; }

/// OpenEXR makes room for the table and for chunks before it reads them.
void require_chunks_in_file(const std::filesystem::path& path, const PartSize& part, std::streamoff size) {
  if (!part.window) return;
  const std::int64_t width = std::int64_t{part.window->x1} - part.window->x0 + 1;
  const std::int64_t height = std::int64_t{part.window->y1} - part.window->y0 + 1;
  if (width < 1 || height < 1)
    throw Error("{}: expected a sound OpenEXR file, found a picture of {} x {} pixels", path.string(), width, height);
  const bool tiled = part.tile.width > 0 && part.tile.height > 0;
  const std::int64_t chunk_width = tiled ? part.tile.width : width,
                     chunk_height = tiled ? part.tile.height : kMostLines;
  const std::int64_t columns = parts_of(width, chunk_width), rows = parts_of(height, chunk_height);
  const std::int64_t most_pixels = kSomePixels + kPixelsAByte * size;
  if (columns > size / kOffsetBytes / rows || chunk_width > most_pixels / chunk_height)
    throw Error("{}: expected a sound OpenEXR file, found {} x {} chunks of {} x {} pixels in a file of {} bytes",
                path.string(), columns, rows, chunk_width, chunk_height, size);
}

/// Types of attributes that always have the same size, which is what OpenEXR reads of them, whatever they claim.
constexpr std::pair<std::string_view, std::uint32_t> kSizes[] = {
    {"box2i", 16},      {"box2f", 16},   {"chromaticities", 32},
    {"compression", 1}, {"double", 8},   {"envmap", 1},
    {"float", 4},       {"int", 4},      {"keycode", 28},
    {"lineOrder", 1},   {"m33f", 36},    {"m33d", 72},
    {"m44f", 64},       {"m44d", 128},   {"rational", 8},
    {"tiledesc", 9},    {"timecode", 8}, {"v2i", 8},
    {"v2f", 8},         {"v2d", 16},     {"v3i", 12},
    {"v3f", 12},        {"v3d", 24}};

/// The bytes that OpenEXR takes for an attribute at the file's position.
std::streamoff bytes_read(std::string_view type, std::uint32_t bytes, std::ifstream& file) {
  for (const auto& [known, size] : kSizes)
    if (type == known) return size;
  const std::streamoff start = file.tellg();
  if (type == "chlist") {
    constexpr std::streamoff kChannelBytes = 16;
    for (char name[kLongestName]; file.getline(name, kLongestName, '\0') && name[0] != '\0';)
      file.seekg(kChannelBytes, std::ios::cur);
    return file ? std::streamoff{file.tellg() - start} : -1;
  }
  if (type == "preview") {
    std::uint32_t sides[2] = {};
    file.read(reinterpret_cast<char*>(sides), sizeof sides);
    return sides[1] == 0 || sides[0] < (1u << 30) / sides[1]
               ? static_cast<std::streamoff>(sizeof sides + std::size_t{4} * sides[0] * sides[1])
               : -1;
  }
  return bytes;
}

void require_size(const std::filesystem::path& path, std::string_view name, std::string_view type, std::uint32_t bytes,
                  std::ifstream& file) {
  const std::streamoff start = file.tellg(), read = bytes_read(type, bytes, file);
  if (read != std::streamoff{bytes})
    throw Error("{}: expected a sound OpenEXR file, found '{}' of type {} in {} bytes", path.string(), name, type,
                bytes);
  file.seekg(start);
}

/// Reads an attribute that tells the size of a part; others are passed over.
void read_size(std::string_view name, std::uint32_t bytes, std::ifstream& file, PartSize& part) {
  const std::streamoff next = file.tellg() + std::streamoff{bytes};
  if (name == "dataWindow" && bytes == sizeof(Window))
    file.read(reinterpret_cast<char*>(&part.window.emplace()), sizeof(Window));
  if (name == "tiles" && bytes > sizeof part.tile) file.read(reinterpret_cast<char*>(&part.tile), sizeof part.tile);
  file.seekg(next);
}

}  // namespace

void require_sane_exr_header(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary | std::ios::ate);
  const std::streamoff size = file.tellg();
  std::uint32_t version = 0;
  file.seekg(kStart - static_cast<std::streamoff>(sizeof version));
  file.read(reinterpret_cast<char*>(&version), sizeof version);
  // A header ends with an empty name; the headers of several parts end with an empty one.
  char name[kLongestName], type[kLongestName];
  PartSize part;
  for (bool at_start = true; file.getline(name, kLongestName, '\0');) {
    if (name[0] == '\0') {
      require_chunks_in_file(path, part, size);
      if (at_start || !(version & kSeveralParts)) return;
      at_start = true, part = {};
      continue;
    }
    at_start = false;
    std::uint32_t bytes = 0;
    file.getline(type, kLongestName, '\0').read(reinterpret_cast<char*>(&bytes), sizeof bytes);
    if (!file) return;
    if (bytes > size - file.tellg())
      throw Error("{}: expected a sound OpenEXR file, found an attribute of {} bytes in a file of {}", path.string(),
                  bytes, size);
    require_size(path, name, type, bytes, file);
    read_size(name, bytes, file, part);
  }
}

}  // namespace redmap
