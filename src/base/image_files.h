// The picture formats behind image.h; not part of the public interface.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "base/image.h"

namespace redmap {

/// Throws Error naming `path` where a picture of this size should not be read.
void require_sane_size(const std::filesystem::path& path, long long width, long long height, long long channels);

/// Names of the channels of `image`, in its order. Throws Error naming `path` where they have none.
std::vector<std::string> channel_names_of(const Image& image, const std::filesystem::path& path);

Image read_exr(const std::filesystem::path& path);
void write_exr(const Image& image, const std::filesystem::path& path, ExrPrecision precision);
Image read_png(const std::filesystem::path& path);
Image read_jpeg(const std::filesystem::path& path);
void write_png(const Image& image, const std::filesystem::path& path);

}  // namespace redmap
