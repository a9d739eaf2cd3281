// What exported materials lose beside the map that they are made from, against a supersampled reference.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace redmap::bench {

struct ExportBenchOptions {
  std::vector<std::string> objects{"sphere"};
  std::vector<std::string> shaders;  ///< empty: all of the library that do not vary in time
  std::vector<double> minifications{4};
  int map_size = 512;
  int reference_spp = 512;
  int views = 2;
  std::filesystem::path models = "models";
  std::function<void(double)> progress;
  std::function<bool()> cancelled;
};

struct ExportBenchRow {
  std::string object, shader, verdict;
  double minification = 0;
  int basis = 0;
  std::vector<float> fit_errors;                                                ///< of each basis reflectance
  double rmse_map = 0, rmse_materials = 0, rmse_one_material = 0, rmse_64 = 0;  ///< interior, linear, unclamped
  double reference_residual = 0;
};

std::vector<ExportBenchRow> measure_exports(const ExportBenchOptions& options);

}  // namespace redmap::bench
