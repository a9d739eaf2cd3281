// Whether a device renders what the CPU does.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "scene/method.h"
#include "surface/surface.h"

namespace redmap::bench {

struct ParityOptions {
  std::string device;                                 ///< as in Device::open()
  std::vector<std::string> shaders;                   ///< of the library; empty: all
  std::vector<double> distances{0.4, 0.8, 2, 6, 20};  ///< texels across a pixel: from the shader itself to far away
  int map_size = 256;
  int pixels = 96;  ///< of a picture's side, at most
  Method method = Method::kMap;
  std::function<void(double)> progress;  ///< told the part done
  std::function<bool()> cancelled;
};

struct ParityRow {
  std::string shader;
  double distance = 0;
  double rmse = 0;  ///< between CPU and device, over pixels that see one face of one object in the same light
  double max_error = 0;
};

/// Bakes and renders the same on the CPU and on the device. Behind shaders that let light pass stand a checkered ball,
/// one of the same shader, and a wall for their shadows.
std::vector<ParityRow> measure_parity(const std::shared_ptr<const Surface>& surface, const ParityOptions& options);

}  // namespace redmap::bench
