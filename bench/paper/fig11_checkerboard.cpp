// Fig. 11: the checkerboard on a device.
#include <fmt/format.h>

#include "base/error.h"
#include "device/device.h"
#include "figures.h"
#include "gpu/frame_times.h"

namespace redmap::bench {

namespace {

std::string label_of(const FrameTimeRow& row) {
  if (row.draws_one_basis) return "one reflectance, 1 sample";
  if (row.method == Method::kMap) return fmt::format("map, {} sample{}", row.spp, row.spp == 1 ? "" : "s");
  return fmt::format("the shader, {} sample{}", row.spp, row.spp == 1 ? "" : "s");
}

/// Frames a second in the paper; nothing for what it has not.
Value paper_rate(const FrameTimeRow& row) {
  if (row.spp != 1 || row.draws_one_basis) return {};
  return row.method == Method::kMap ? 16.0 : 18.0;
}

FrameTimeOptions options_for(Laboratory& laboratory) {
  FrameTimeOptions options;
  options.device = laboratory.options().device;
  options.shaders = {"checker"};
  options.lights = {1};
  options.width = laboratory.samples(1280, 640), options.height = laboratory.samples(720, 360);
  options.map_size = laboratory.options().map_size;
  options.frames = laboratory.samples(9, 3);
  options.progress = [&laboratory](double part) { laboratory.step(part); };
  return options;
}

}  // namespace

Figure measure_fig11(Laboratory& laboratory) {
  Figure figure;
  figure.title = "Fig. 11: the checkerboard on a GPU";
  figure.paper =
      "Frames a second on an Nvidia Quadro NVS 280: 18 by the shader itself, 16 by the map (one normal, trilinear). "
      "The "
      "original aliases.";
  figure.ours =
      "A wall of 15 balls of checkerboard that share one map, one shadowed light, two texels to a pixel; the device's "
      "own time, the median of several frames. RMSE: of one such ball against 256 samples.";
  const FrameTimeOptions options = options_for(laboratory);
  try {
    figure.notes.push_back("Device: " + Device::open(options.device)->info().name);
  } catch (const Error& error) {
    figure.notes.push_back(std::string("Not measured: ") + error.what());
    return figure;
  }
  Table table{"rates",
              fmt::format("Frames a second at {} x {}", options.width, options.height),
              {{"method", "method"},
               {"paper_rate", "frames a second, paper"},
               {"rate", "here"},
               {"milliseconds", "ms"},
               {"rmse", "RMSE"}},
              {}};
  double original = 0, map = 0;
  for (const FrameTimeRow& row : measure_frame_times(options)) {
    if (row.method == Method::kOriginal) original = row.milliseconds_per_frame;
    if (row.method == Method::kMap && row.spp == 1 && !row.draws_one_basis) map = row.milliseconds_per_frame;
    table.rows.push_back({label_of(row), paper_rate(row), 1e3 / row.milliseconds_per_frame, row.milliseconds_per_frame,
                          row.rmse_interior});
  }
  figure.tables.push_back(std::move(table));
  figure.claims.push_back({"time of the map / that of the shader at 1 sample: the paper's 1.13 or less",
                           text_of(map / original), map <= 18.0 / 16 * original});
  return figure;
}

}  // namespace redmap::bench
