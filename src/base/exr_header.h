// A look at the header of an OpenEXR file before OpenEXR reads it: it believes whatever size an attribute claims, and a
// damaged file of some kilobytes takes gigabytes.
#pragma once

#include <filesystem>

namespace redmap {

/// Throws Error naming `path` where an attribute claims more bytes than the file has or others than its type, or pixels
/// more chunks, or larger ones, than can be in it. All else that may be wrong is left for OpenEXR to say.
void require_sane_exr_header(const std::filesystem::path& path);

}  // namespace redmap
