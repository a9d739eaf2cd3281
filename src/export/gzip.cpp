#include "export/gzip.h"

#include <zlib.h>

#include "base/error.h"

namespace redmap {

std::string gzip(std::string_view bytes) {
  // zlib's largest window, and 16 for gzip's header; 8 is its default memory.
  constexpr int kWindow = 15 + 16, kMemory = 8;
  z_stream stream{};
  if (deflateInit2(&stream, Z_BEST_COMPRESSION, Z_DEFLATED, kWindow, kMemory, Z_DEFAULT_STRATEGY) != Z_OK)
    throw Error("gzip: expected memory for the compressor, found none");
  std::string packed(deflateBound(&stream, bytes.size()), '\0');
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data()));
  stream.avail_in = static_cast<uInt>(bytes.size());
  stream.next_out = reinterpret_cast<Bytef*>(packed.data());
  stream.avail_out = static_cast<uInt>(packed.size());
  const int status = deflate(&stream, Z_FINISH);
  packed.resize(stream.total_out);
  deflateEnd(&stream);
  if (status != Z_STREAM_END) throw Error("gzip: expected less than 4 GB, found {} bytes", bytes.size());
  return packed;
}

}  // namespace redmap
