// Files compressed for transfer, as browsers unpack them. Not part of the public interface.
#pragma once

#include <string>
#include <string_view>

namespace redmap {

/// `bytes` as a gzip file (RFC 1952), the same for the same bytes: without name and time. Throws Error.
std::string gzip(std::string_view bytes);

}  // namespace redmap
