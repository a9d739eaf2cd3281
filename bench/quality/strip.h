// The strip of pictures that shows at one glance what redmap does: 1 sample a pixel | redmap | reference, with time and
// error under each and a zoomed inset.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "render/renderer.h"
#include "scene/scene.h"

namespace redmap::bench {

struct StripOptions {
  int reference_spp = 1024;
  int inset_x = 0, inset_y = 0;             ///< top left pixel of what the inset shows
  int inset_width = 60, inset_height = 40;  ///< pixels
  int inset_zoom = 3;
  int repeats = 3;  ///< times are the fastest of so many frames
  std::function<void(double)> progress;
  std::function<bool()> cancelled;  ///< the pictures are not whole after it answered true
};

struct StripPanel {
  std::string label;
  double seconds = 0;
  double rmse = 0;  ///< against the reference, linear light clamped to [0, 1], whole picture
  Image image;
};

/// Renders the panels: 1 sample a pixel, the map, the reference (its rmse is its own residual).
std::vector<StripPanel> render_strip(const Scene& scene, const std::vector<ObjectData>& data,
                                     const StripOptions& options);

/// Side by side, labelled, ready to be written as a PNG.
Image compose_strip(const std::vector<StripPanel>& panels, const StripOptions& options);

}  // namespace redmap::bench
