// How good and how fast every method is, measured by the rules of docs/measuring.md: objects x shaders x minifications
// x methods in one run, against a supersampled reference whose own residual is stated.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "render/renderer.h"

namespace redmap::bench {

struct QualityOptions {
  std::vector<std::string> objects{"sphere", "bunny"};
  std::vector<std::string> shaders;  ///< empty: all of the library that can be baked
  std::vector<double> minifications{4, 8};
  std::vector<std::string> methods;  ///< empty: all
  int map_size = 1024;
  int reference_spp = 1024;
  int views = 0;           ///< 0: as many as give about 20 000 pixels, 8 at most
  int flicker_frames = 0;  ///< 0: flicker is not measured
  int repeats = 3;         ///< timings are the fastest of so many frames
  std::filesystem::path models = "models";
  std::function<void(double, const std::string&)> progress;  ///< part done, and what is being done
  std::function<bool()> cancelled;
};

struct QualityRow {
  std::string object, shader;
  double minification = 0;
  std::string method;
  std::string quality;  ///< empty where it does not apply
  int spp = 0;          ///< 0 where it does not apply
  double seconds_per_frame = 0, rays_per_pixel = 0, shader_calls_per_pixel = 0, lookups_per_pixel = 0;
  double rmse_interior = 0;          ///< linear light, unclamped; seams included
  double rmse_interior_clamped = 0;  ///< the same clamped to [0, 1]
  double rmse_brightest_tenth = 0;   ///< clamped, over the brightest tenth of the interior
  double rmse_seams = 0, rmse_silhouette = 0, bias_interior = 0;
  double rmse_95th_percentile = 0;  ///< of the per-pixel error in the interior
  double equal_quality_spp = 0;     ///< samples of the shader itself that reach rmse_interior
  std::optional<double> flicker, flicker_slow;
  double reference_residual = 0;  ///< of the reference itself, interior
  int basis = 0;                  ///< of the map
};

std::vector<QualityRow> measure_quality(const QualityOptions& options);

/// Methods that options.methods can name, in the order of the table.
std::vector<std::string> quality_methods();

}  // namespace redmap::bench
