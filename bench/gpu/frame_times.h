// How long a frame takes on a device, and how far it is from the truth.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "scene/method.h"

namespace redmap::bench {

struct FrameTimeOptions {
  std::string device;  ///< as in Device::open()
  /// Of the library: one that costs almost nothing itself, and such as productions have.
  std::vector<std::string> shaders{"checker", "wood", "worn_paint", "stone"};
  double minification = 2;  ///< texels of the map across a pixel, in the median
  std::vector<int> lights{1, 16};
  int width = 1920, height = 1080;
  int map_size = 1024;
  int frames = 3;           ///< timed, after one that is not; the median counts
  int reference_spp = 256;  ///< of the picture that errors are taken against
  std::function<void(double)> progress;
  std::function<bool()> cancelled;
};

/// A method of one case. `spp` are its samples a pixel.
struct FrameTimeRow {
  std::string shader;
  int lights = 1;
  Method method = Method::kMap;
  bool draws_one_basis = false;
  int spp = 1;
  double milliseconds_per_frame = 0;  ///< from handing over to the end, shadow maps included, nothing copied back
  double rmse_interior = 0;           ///< of one ball at the same distance
};

/// Shaders x lights x methods. The timed picture is a wall of balls that share one map, two texels to a pixel.
std::vector<FrameTimeRow> measure_frame_times(const FrameTimeOptions& options);

}  // namespace redmap::bench
