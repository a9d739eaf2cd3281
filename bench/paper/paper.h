// The paper's Figs. 1 and 4 to 11 measured anew in one run, each beside the paper's own figures, by the paper's method
// and by ours, with the ablations that the paper only asserts (docs/paper.md).
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "report.h"

namespace redmap::bench {

struct PaperOptions {
  bool quick = false;                ///< fewer frames, fewer reference samples, fewer distances: minutes
  bool all_frames = false;           ///< all 840 frames of Fig. 1
  std::vector<std::string> figures;  ///< as in paper_figures(); empty: all
  int map_size = 1024;               ///< texels across, as in the paper
  std::string object;                ///< stands in for all meshes: "sphere" needs no models; empty: bunny and dragon
  std::string device;                ///< of Fig. 11, as in Device::open()
  std::filesystem::path models = "models";
  std::function<void(double part, const std::string& what)> progress;
  std::function<void(const Figure&)> figure_done;
  std::function<bool()> cancelled;
};

/// Ids of the figures, in order.
std::vector<std::string> paper_figures();

/// Throws Error on an unknown figure or object, where a mesh is missing, and if it was cancelled.
Report measure_paper(const PaperOptions& options);

}  // namespace redmap::bench
