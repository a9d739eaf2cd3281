// The pictures of one case side by side, enlarged.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "base/image.h"

namespace redmap::bench {

struct CasePicture {
  std::string label;
  Image image;  ///< all of one size
};

/// Writes them as one PNG, making its folder. Exposed such that the brightest hundredth of the first is white.
void write_case_picture(const std::vector<CasePicture>& pictures, const std::filesystem::path& path);

}  // namespace redmap::bench
