// `redmap compare`: how far pictures are from a reference. A picture that is far explains itself: the largest and the
// mean error, the worst pixels, a picture of the difference (after Magnum's CompareImage).
#include <fmt/format.h>

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "base/error.h"
#include "base/image.h"
#include "base/parallel.h"
#include "commands.h"
#include "common.h"
#include "metrics/compare.h"
#include "scene/frame_spec.h"

namespace redmap::cli {

namespace {

struct Options {
  std::string image, reference;
  std::string mask;
  std::string frames;
  std::string difference;
  float gain = 1;
  CompareOptions compare;
  CommonOptions common;
};

/// The files to compare, frame by frame; a still picture is a sequence of one.
struct Frames {
  std::vector<int> numbers;
  std::vector<std::filesystem::path> images, references, masks;
};

Frames list_frames(const Options& options) {
  Frames frames;
  const bool sequence = has_frame_number(options.image);
  if (sequence && options.frames.empty())
    throw Error("compare: expected --frames with \"{}\", found none", options.image);
  if (!sequence && !options.frames.empty())
    throw Error("compare: expected a name like out.####.exr with --frames, found \"{}\"", options.image);
  frames.numbers = sequence ? parse_frames(options.frames) : std::vector<int>{0};
  for (const int number : frames.numbers) {
    frames.images.emplace_back(frame_path(options.image, number));
    frames.references.emplace_back(frame_path(options.reference, number));
    if (!options.mask.empty()) frames.masks.emplace_back(frame_path(options.mask, number));
  }
  return frames;
}

nlohmann::json to_json(const PixelDifference& pixel) {
  return {{"x", pixel.x},
          {"y", pixel.y},
          {"image", {pixel.image.r, pixel.image.g, pixel.image.b}},
          {"reference", {pixel.reference.r, pixel.reference.g, pixel.reference.b}},
          {"error", pixel.error}};
}

/// JSON has no infinity: the PSNR of equal pictures is null.
nlohmann::json finite_or_null(double value) { return std::isfinite(value) ? nlohmann::json(value) : nullptr; }

nlohmann::json to_json(const SequenceComparison& result, const Frames& frames) {
  const Comparison& all = result.all;
  nlohmann::json worst = nlohmann::json::array();
  for (const PixelDifference& pixel : all.worst) worst.push_back(to_json(pixel));
  const bool sequence = frames.numbers.size() > 1;
  return {{"rmse", all.rmse},
          {"rmse_clamped", all.rmse_clamped},
          {"psnr", finite_or_null(all.psnr)},
          {"relative_mse", all.relative_mse},
          {"bias", all.bias},
          {"flip", all.flip},
          {"flicker", sequence ? nlohmann::json(result.flicker) : nullptr},
          {"mean_error", all.mean_error},
          {"max_error", all.max_error},
          {"pixels", all.pixels},
          {"frames", frames.numbers.size()},
          {"worst_frame", sequence ? nlohmann::json(frames.numbers[result.worst_frame]) : nullptr},
          {"worst_pixels", worst}};
}

void print_result(const SequenceComparison& result, const Frames& frames) {
  const Comparison& all = result.all;
  fmt::print("RMSE          {:.6f}   clamped to [0, 1]: {:.6f}, PSNR {:.2f} dB\n", all.rmse, all.rmse_clamped,
             all.psnr);
  fmt::print("relative MSE  {:.6f}\n", all.relative_mse);
  fmt::print("bias          {:+.6f}\n", all.bias);
  fmt::print("FLIP          {:.6f}\n", all.flip);
  if (frames.numbers.size() > 1)
    fmt::print("flicker       {:.6f}   over {} frames; the worst is {}\n", result.flicker, frames.numbers.size(),
               frames.numbers[result.worst_frame]);
  fmt::print("error         mean {:.6f}, maximum {:.6f}, of {} pixels\n", all.mean_error, all.max_error, all.pixels);
  for (const PixelDifference& pixel : all.worst) {
    if (pixel.error == 0) continue;
    fmt::print("  pixel ({}, {}): ({:.4f}, {:.4f}, {:.4f}), expected ({:.4f}, {:.4f}, {:.4f})\n", pixel.x, pixel.y,
               pixel.image.r, pixel.image.g, pixel.image.b, pixel.reference.r, pixel.reference.g, pixel.reference.b);
  }
}

void write_difference(const Options& options, const Frames& frames) {
  if (options.difference.empty()) return;
  if (frames.numbers.size() > 1 && !has_frame_number(options.difference))
    throw Error("compare: expected a name like difference.####.png for {} frames, found \"{}\"", frames.numbers.size(),
                options.difference);
  for (std::size_t i = 0; i < frames.numbers.size(); ++i) {
    std::optional<Image> mask;
    if (!frames.masks.empty()) mask = read_image(frames.masks[i]);
    const Image picture = difference_picture(read_image(frames.images[i]), read_image(frames.references[i]),
                                             mask ? &*mask : nullptr, options.gain);
    write_image(picture, frame_path(options.difference, frames.numbers[i]));
  }
}

void compare(const Options& options) {
  const ThreadLimit limit(static_cast<std::size_t>(options.common.threads));
  const Frames frames = list_frames(options);
  const SequenceComparison result = compare_sequences(frames.images, frames.references, frames.masks, options.compare);
  print_result(result, frames);
  write_difference(options, frames);
  write_json(options.common.json, to_json(result, frames));
}

}  // namespace

void add_compare_command(CLI::App& app) {
  CLI::App* sub = app.add_subcommand("compare", "Measure how far pictures are from a reference");
  sub->footer(
      "Examples:\n"
      "  redmap compare out.exr reference.exr\n"
      "  redmap compare out.exr reference.exr --mask interior.exr --difference difference.png --gain 4\n"
      "  redmap compare out.####.exr reference.####.exr --frames 1-30 --json result.json");
  auto options = std::make_shared<Options>();
  sub->add_option("image", options->image, "picture to judge, .exr or .png; with #### for frames")->required();
  sub->add_option("reference", options->reference, "what it should look like, of the same size")->required();
  sub->add_option("--mask", options->mask, "only pixels above .5 in this picture count")->type_name("FILE");
  sub->add_option("--frames", options->frames, "frames to compare, such as 1-300,310,320-400:2")->type_name("SPEC");
  sub->add_option("--difference", options->difference, "write a picture of the absolute error here, .png or .exr")
      ->type_name("FILE");
  sub->add_option("--gain", options->gain, "times which the difference picture shows the error")->capture_default_str();
  sub->add_option("--worst", options->compare.worst_pixels, "how many of the worst pixels to list")
      ->check(CLI::Range(0, 1000))
      ->capture_default_str();
  add_common_options(*sub, options->common);
  sub->callback([options] { compare(*options); });
}

}  // namespace redmap::cli
