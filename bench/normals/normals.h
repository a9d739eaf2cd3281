// How well bumpy, glossy surfaces are filtered: objects x bumps x glosses x minifications x methods in one run, against
// a supersampled reference whose own residual is stated (docs/measuring.md).
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace redmap::bench {

struct NormalsOptions {
  std::vector<std::string> objects{"plane", "sphere", "bunny"};
  std::vector<std::string> bumps{"fbm.25", "ridges", "brick", "snow"};
  std::vector<std::string> glosses{"phong100", "ggx.1"};
  std::vector<double> minifications{4, 16, 64};
  std::vector<std::string> methods{"map", "paper", "parameters", "supersample"};
  std::vector<int> spp{16, 64};  ///< of supersample
  int map_size = 1024;
  int reference_spp = 1600;
  int largest = 64;                ///< pixels a side of a view, at most
  int views = 0;                   ///< 0: as many as give about 2 000 interior pixels, 8 at most
  int flicker_frames = 0;          ///< 0: flicker is not measured
  int repeats = 3;                 ///< timings are the fastest of so many frames
  double shader_microseconds = 0;  ///< at least, a point; 0: what the shader costs by itself
  std::filesystem::path models = "models";
  std::filesystem::path pictures;                            ///< folder for one picture a case; empty: none
  std::function<void(double, const std::string&)> progress;  ///< part done, and what is being done
  std::function<bool()> cancelled;
};

struct NormalsRow {
  std::string object, bump, gloss;
  double minification = 0;
  std::string method;
  std::string quality;                          ///< of the map: "default" or "fast"; else empty
  int spp = 0;                                  ///< of supersample, else 0
  double relative_rmse = 0;                     ///< over the mean of the reference, interior
  std::optional<double> flicker, flicker_slow;  ///< likewise
  double shader_calls_per_lookup = 0;           ///< of the pixels of the object; supersample has one lookup a pixel
  double microseconds_per_pixel = 0;            ///< of the whole picture, all threads together
  double supersampled_part = 0;                 ///< of the pixels of the object, by the method's own choice
  double reference_residual = 0;                ///< relative, of the reference itself
  int basis = 0;                                ///< of the map
  double pixels = 0;                            ///< interior, over all views
};

std::vector<NormalsRow> measure_normals(const NormalsOptions& options);

}  // namespace redmap::bench
