#include "base/exr_header.h"

#include <cstdint>
#include <fstream>

#include "base/error.h"

namespace redmap {

namespace {

/// Bytes before the first attribute: magic number, version. Bit 12 of the version: several parts.
constexpr std::streamoff kStart = 8;
constexpr std::uint32_t kSeveralParts = 1u << 12;
/// Names and types have at most 255 characters and a zero.
constexpr std::streamsize kLongestName = 256;

}  // namespace

void require_sane_exr_header(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary | std::ios::ate);
  const std::streamoff size = file.tellg();
  std::uint32_t version = 0;
  file.seekg(kStart - static_cast<std::streamoff>(sizeof version));
  file.read(reinterpret_cast<char*>(&version), sizeof version);
  // A header ends with an empty name; the headers of several parts end with an empty one.
  char name[kLongestName], type[kLongestName];
  for (bool at_start = true; file.getline(name, kLongestName, '\0');) {
    if (name[0] == '\0') {
      if (at_start || !(version & kSeveralParts)) return;
      at_start = true;
      continue;
    }
    at_start = false;
    std::uint32_t bytes = 0;
    file.getline(type, kLongestName, '\0').read(reinterpret_cast<char*>(&bytes), sizeof bytes);
    if (!file) return;
    if (bytes > size - file.tellg())
      throw Error("{}: expected a sound OpenEXR file, found an attribute of {} bytes in a file of {}", path.string(),
                  bytes, size);
    file.seekg(bytes, std::ios::cur);
  }
}

}  // namespace redmap
