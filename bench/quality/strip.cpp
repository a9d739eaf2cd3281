#include "strip.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "label.h"
#include "metrics/compare.h"

namespace redmap::bench {

namespace {

constexpr int kLabelHeight = 40, kGap = 4, kBorder = 2;

RenderOptions supersampled(int spp, std::uint64_t seed) {
  RenderOptions options;
  options.method = Method::kSupersample;
  options.spp = spp;
  options.seed = seed;
  return options;
}

double rmse_between(const Image& image, const Image& reference) {
  CompareOptions options;
  options.flip = false;
  return compare_images(image, reference, options).rmse_clamped;
}

StripPanel render_panel(std::string label, const Scene& scene, const std::vector<ObjectData>& data,
                        RenderOptions options, const StripOptions& strip, int repeats) {
  options.cancelled = strip.cancelled;
  Renderer renderer(scene, options, data);
  StripPanel panel{std::move(label), std::numeric_limits<double>::infinity(), 0, {}};
  for (int repeat = 0; repeat < repeats; ++repeat) {
    RenderedFrame frame = renderer.render(scene, 1);
    panel.seconds = std::min(panel.seconds, frame.seconds);
    panel.image = std::move(frame.image);
  }
  return panel;
}

void copy_into(const Image& from, int zoom, int from_x, int from_y, int width, int height, Image& to, int x, int y) {
  for (int j = 0; j < height * zoom; ++j)
    for (int i = 0; i < width * zoom; ++i) to.set_rgb(x + i, y + j, from.rgb(from_x + i / zoom, from_y + j / zoom));
}

void fill(Image& image, int x, int y, int width, int height, Rgb color) {
  for (int j = y; j < y + height; ++j)
    for (int i = x; i < x + width; ++i) image.set_rgb(i, j, color);
}

}  // namespace

std::vector<StripPanel> render_strip(const Scene& scene, const std::vector<ObjectData>& data,
                                     const StripOptions& options) {
  const auto report = [&](double part) {
    if (options.progress) options.progress(part);
  };
  report(0);
  std::vector<StripPanel> panels;
  panels.push_back(render_panel("1 sample a pixel", scene, data, supersampled(1, 0), options, options.repeats));
  panels.push_back(render_panel("redmap", scene, data, {}, options, options.repeats));
  report(0.1);
  // Two independent halves tell how far the reference itself can be trusted.
  StripPanel reference = render_panel(fmt::format("reference, {} samples", options.reference_spp), scene, data,
                                      supersampled(options.reference_spp / 2, 1), options, 1);
  report(0.55);
  const StripPanel half = render_panel("", scene, data, supersampled(options.reference_spp / 2, 2), options, 1);
  reference.rmse = rmse_between(reference.image, half.image) / 2;
  reference.seconds += half.seconds;
  for (std::size_t i = 0; i < reference.image.data.size(); ++i)
    reference.image.data[i] = 0.5f * (reference.image.data[i] + half.image.data[i]);
  for (StripPanel& panel : panels) panel.rmse = rmse_between(panel.image, reference.image);
  panels.push_back(std::move(reference));
  return panels;
}

Image compose_strip(const std::vector<StripPanel>& panels, const StripOptions& options) {
  const int width = panels.front().image.width, height = panels.front().image.height;
  const int count = static_cast<int>(panels.size());
  Image strip(count * width + (count - 1) * kGap, height + kLabelHeight, 3, 1.0f);
  for (int p = 0; p < count; ++p) {
    const StripPanel& panel = panels[p];
    const int x = p * (width + kGap);
    copy_into(panel.image, 1, 0, 0, width, height, strip, x, 0);
    const int inset_width = options.inset_width * options.inset_zoom;
    const int inset_height = options.inset_height * options.inset_zoom;
    const int inset_y = height - inset_height - 2 * kBorder;
    fill(strip, x, inset_y, inset_width + 2 * kBorder, inset_height + 2 * kBorder, {1, 1, 1});
    copy_into(panel.image, options.inset_zoom, options.inset_x, options.inset_y, options.inset_width,
              options.inset_height, strip, x + kBorder, inset_y + kBorder);
    draw_label(strip, x + 4, height + 4, panel.label, 2, {});
    draw_label(strip, x + 4, height + 24, fmt::format("{:.3g} s   RMSE {:.4f}", panel.seconds, panel.rmse), 2, {});
  }
  return strip;
}

}  // namespace redmap::bench
