#include "scene/camera_rays.h"

#include "base/random.h"

namespace redmap {

void append_pixel_samples(std::uint32_t pixel, int image_width, int columns, int rows, std::uint64_t jitter_seed,
                          std::vector<CameraSample>& samples) {
  const float x0 = static_cast<float>(pixel % image_width), y0 = static_cast<float>(pixel / image_width);
  const float width = 1.0f / static_cast<float>(columns), height = 1.0f / static_cast<float>(rows);
  const float extent = std::sqrt(width * height);
  Random random(jitter_seed);
  for (int j = 0; j < rows; ++j)
    for (int i = 0; i < columns; ++i) {
      const float jitter_x = jitter_seed ? random.next_float() : 0.5f;
      const float jitter_y = jitter_seed ? random.next_float() : 0.5f;
      samples.push_back({pixel, x0 + (static_cast<float>(i) + jitter_x) * width,
                         y0 + (static_cast<float>(j) + jitter_y) * height, extent, width * height});
    }
}

Strata strata_of(int spp) {
  int rows = static_cast<int>(std::sqrt(static_cast<float>(spp)));
  while (rows > 1 && spp % rows != 0) --rows;
  return {spp / rows, rows};
}

}  // namespace redmap
