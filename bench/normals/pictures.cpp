#include "pictures.h"

#include <algorithm>

#include "quality/label.h"

namespace redmap::bench {

namespace {

constexpr int kPanel = 256;  // pixels a side of a picture, about
constexpr int kGap = 4, kLabelHeight = 12;

/// What to multiply by so that the brightest hundredth becomes 1.
float exposure_of(const Image& image) {
  std::vector<float> values = image.data;
  const auto at = values.begin() + static_cast<std::ptrdiff_t>(values.size() * 99 / 100);
  std::nth_element(values.begin(), at, values.end());
  return 1 / std::max(*at, 1e-3f);
}

}  // namespace

void write_case_picture(const std::vector<CasePicture>& pictures, const std::filesystem::path& path) {
  const Image& first = pictures.front().image;
  const int zoom = std::max(1, kPanel / first.width), step = first.width * zoom + kGap;
  const float exposure = exposure_of(first);
  Image sheet(step * static_cast<int>(pictures.size()) - kGap, first.height * zoom + kLabelHeight, 3, 1.0f);
  for (std::size_t p = 0; p < pictures.size(); ++p) {
    const int left = step * static_cast<int>(p);
    for (int y = 0; y < first.height * zoom; ++y)
      for (int x = 0; x < first.width * zoom; ++x)
        sheet.set_rgb(left + x, y, pictures[p].image.rgb(x / zoom, y / zoom) * exposure);
    draw_label(sheet, left + 2, first.height * zoom + 2, pictures[p].label, 1, {});
  }
  std::filesystem::create_directories(path.parent_path());
  write_image(sheet, path);
}

}  // namespace redmap::bench
