// How often the bounds of certificates hold on frames they never saw: whole frames of other cameras and other lights,
// rendered as users render them, against references (docs/verify.md).
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "verify/verify.h"

namespace redmap::bench {

struct CoverageOptions {
  std::vector<std::string> objects{"sphere", "bunny"};
  std::vector<std::string> shaders{"noise", "scales", "marble", "two_tinted_satin", "wood", "hammered_metal"};
  int map_size = 256;
  int scenes = 150;          ///< for each object and shader, each with its own camera and light
  int pixels_per_scene = 4;  ///< random interior pixels that are lit
  int frame_pixels = 16;     ///< a side of the frames
  int reference_spp = 1024;
  VerifyOptions verify;  ///< what the certificates are made with
  std::filesystem::path models = "models";
  std::function<void(double)> progress;  ///< from any thread
  std::function<bool()> cancelled;
};

struct CoverageRow {
  std::string object, shader;
  int pixels = 0;       ///< held out
  double coverage = 0;  ///< part of them within their bound
  double rms_error = 0, mean_error = 0;
  double mean_bound = 0;  ///< of the same pixels
  int beyond = 0;         ///< pixels that no row of the certificate is about; they do not count
};

/// A row for each object and shader.
std::vector<CoverageRow> measure_coverage(const CoverageOptions& options);

}  // namespace redmap::bench
