// The rays of one tile of pixels, by method.
#pragma once

#include <vector>

#include "base/random.h"
#include "render/renderer.h"
#include "render/wavefront.h"

namespace redmap {

/// Pixels a side of tiles: about 4 096 samples, a wavefront that stays in the second-level cache; fewer where a picture
/// would have so few tiles that threads run out of them.
inline int tile_size(const RenderOptions& options, int width, int height) {
  constexpr int kLeast = 16, kTiles = 16;
  int size = options.method != Method::kPaper && options.quality == Quality::kFast ? 64 : 32;
  while (size > kLeast && width * height < kTiles * size * size) size /= 2;
  return size;
}

/// What is shaded as one. Half a pixel is what every ray stands for at default quality.
inline void set_quality(const RenderOptions& options, FrameContext& frame) {
  frame.quarters = options.quality == Quality::kBalanced && options.method == Method::kMap;
  frame.joined_pixels = options.method == Method::kPaper ? 0 : options.quality == Quality::kDefault ? 0.5f : 1.0f;
}

struct Tile {
  int x0, y0, x1, y1;  ///< pixels, end excluded
};

struct TileJob {
  const FrameContext* frame;
  const RenderOptions* options;
  const std::vector<std::uint8_t>* supersampled;  ///< by object
  int image_width;
  std::uint64_t frame_seed;
  PixelSums pixels;
  PixelClass* classes;  ///< null if not asked for
};

/// What the jittered samples of a pixel are drawn from.
inline std::uint64_t jitter_seed(const TileJob& job, std::uint32_t pixel) { return hash64(pixel, job.frame_seed) | 1; }

/// Jittered samples of the shader itself.
RenderCounts render_supersampled(const TileJob& job, Tile tile);
/// A regular grid of samples, refined at silhouettes, chart seams and occlusions.
RenderCounts render_grid(const TileJob& job, Tile tile);
/// Four corner rays and one centre ray a pixel, subdivided where the corners see different objects or charts.
RenderCounts render_paper(const TileJob& job, Tile tile);

}  // namespace redmap
