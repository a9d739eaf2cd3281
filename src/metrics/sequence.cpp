// Errors and flicker of a sequence of frames against its reference.
#include <cmath>

#include "base/error.h"
#include "metrics/compare.h"
#include "metrics/compare_checks.h"

namespace redmap {

namespace {

/// Pools the frames' comparisons as if they were one picture.
class PooledComparison {
 public:
  void add(const Comparison& frame) {
    const auto n = static_cast<double>(frame.pixels);
    sums_.pixels += frame.pixels;
    sums_.rmse += n * frame.rmse * frame.rmse;
    sums_.rmse_clamped += n * frame.rmse_clamped * frame.rmse_clamped;
    sums_.relative_mse += n * frame.relative_mse;
    sums_.bias += n * frame.bias;
    sums_.mean_error += n * frame.mean_error;
    sums_.flip += n * frame.flip;
    sums_.max_error = std::max(sums_.max_error, frame.max_error);
  }
  Comparison pooled() const {
    const auto n = static_cast<double>(sums_.pixels);
    Comparison result = sums_;
    result.rmse = std::sqrt(sums_.rmse / n);
    result.rmse_clamped = std::sqrt(sums_.rmse_clamped / n);
    result.psnr = psnr_of(result.rmse_clamped);
    result.relative_mse /= n, result.bias /= n, result.mean_error /= n, result.flip /= n;
    return result;
  }

 private:
  Comparison sums_;  ///< of the squares where the result is a root
};

}  // namespace

void FlickerMeter::add(const Image& image, const Image& reference, const Image* mask) {
  require_comparable(image, reference, mask);
  const bool first = previous_error_.data.empty();
  if (!first && (image.width != previous_error_.width || image.height != previous_error_.height))
    throw Error("compare: expected frames of one size, {} x {}, found {} x {}", previous_error_.width,
                previous_error_.height, image.width, image.height);
  Image error(image.width, image.height, 3);
  std::vector<bool> counted(image.pixels());
  std::size_t pixel = 0;
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x, ++pixel) {
      if (!counts(mask, x, y)) continue;
      counted[pixel] = true;
      const Rgb now = image.rgb(x, y) - reference.rgb(x, y);
      error.set_rgb(x, y, now);
      if (first || !previous_counts_[pixel]) continue;
      const Rgb change = now - previous_error_.rgb(x, y);
      squared_sum_ += static_cast<double>(change.r) * change.r + static_cast<double>(change.g) * change.g +
                      static_cast<double>(change.b) * change.b;
      ++pixels_;
    }
  previous_error_ = std::move(error);
  previous_counts_ = std::move(counted);
}

double FlickerMeter::flicker() const {
  return pixels_ == 0 ? 0 : std::sqrt(squared_sum_ / (3 * static_cast<double>(pixels_)));
}

SequenceComparison compare_sequences(std::span<const std::filesystem::path> images,
                                     std::span<const std::filesystem::path> references,
                                     std::span<const std::filesystem::path> masks, const CompareOptions& options) {
  if (images.empty() || images.size() != references.size() || (!masks.empty() && masks.size() != images.size()))
    throw Error("compare: expected as many references and masks as frames, found {} frames, {} references, {} masks",
                images.size(), references.size(), masks.size());
  SequenceComparison result;
  PooledComparison pooled;
  FlickerMeter flicker;
  double largest_rmse = -1;
  std::vector<PixelDifference> worst;
  for (std::size_t frame = 0; frame < images.size(); ++frame) {
    const Image image = read_image(images[frame]), reference = read_image(references[frame]);
    const Image mask = masks.empty() ? Image() : read_image(masks[frame]);
    CompareOptions frame_options = options;
    if (!masks.empty()) frame_options.mask = &mask;
    const Comparison comparison = compare_images(image, reference, frame_options);
    pooled.add(comparison);
    flicker.add(image, reference, frame_options.mask);
    if (comparison.rmse <= largest_rmse) continue;
    largest_rmse = comparison.rmse;
    result.worst_frame = frame;
    worst = comparison.worst;
  }
  result.all = pooled.pooled();
  result.all.worst = std::move(worst);
  result.flicker = flicker.flicker();
  result.flicker_pixels = flicker.pixels();
  return result;
}

}  // namespace redmap
