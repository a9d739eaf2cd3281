// Errors of one picture against its reference. Sums run over rows in parallel and over the rows in order, so that every
// number of threads gives the same bits.
#include "metrics/compare.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/error.h"
#include "base/parallel.h"
#include "metrics/color_spaces.h"
#include "metrics/compare_checks.h"
#include "metrics/flip.h"

namespace redmap {

namespace {

/// Sums over the channels of some pixels.
struct ErrorSums {
  std::size_t pixels = 0;
  double squared = 0, squared_clamped = 0, relative = 0, signed_error = 0, absolute = 0, largest = 0, flip = 0;

  void add(Rgb image, Rgb reference) {
    ++pixels;
    const Rgb image_clamped = clamped(image), reference_clamped = clamped(reference);
    add_channel(image.r, reference.r, image_clamped.r - reference_clamped.r);
    add_channel(image.g, reference.g, image_clamped.g - reference_clamped.g);
    add_channel(image.b, reference.b, image_clamped.b - reference_clamped.b);
  }
  void add(const ErrorSums& other) {
    pixels += other.pixels;
    squared += other.squared, squared_clamped += other.squared_clamped, relative += other.relative;
    signed_error += other.signed_error, absolute += other.absolute, flip += other.flip;
    largest = std::max(largest, other.largest);
  }

 private:
  void add_channel(double image, double reference, double error_clamped) {
    const double error = image - reference;
    squared += error * error;
    squared_clamped += error_clamped * error_clamped;
    relative += error * error / (reference * reference + kRelativeEpsilon);
    signed_error += error;
    absolute += std::abs(error);
    largest = std::max(largest, std::abs(error));
  }
};

double pixel_error(Rgb image, Rgb reference) {
  const Rgb d = image - reference;
  return std::sqrt((static_cast<double>(d.r) * d.r + static_cast<double>(d.g) * d.g + static_cast<double>(d.b) * d.b) /
                   3);
}

std::vector<PixelDifference> find_worst(const Image& image, const Image& reference, const Image* mask, int count) {
  const auto worse = [](const PixelDifference& a, const PixelDifference& b) { return a.error > b.error; };
  std::vector<PixelDifference> worst;  // a heap whose front is the least bad
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) {
      if (!counts(mask, x, y)) continue;
      const Rgb a = image.rgb(x, y), b = reference.rgb(x, y);
      const double error = pixel_error(a, b);
      if (static_cast<int>(worst.size()) == count) {
        if (count == 0 || error <= worst.front().error) continue;
        std::pop_heap(worst.begin(), worst.end(), worse);
        worst.pop_back();
      }
      worst.push_back({x, y, a, b, error});
      std::push_heap(worst.begin(), worst.end(), worse);
    }
  std::sort_heap(worst.begin(), worst.end(), worse);
  return worst;
}

ErrorSums sum_errors(const Image& image, const Image& reference, const Image* mask, const Image& flip) {
  std::vector<ErrorSums> rows(static_cast<std::size_t>(image.height));
  parallel_for(rows.size(), [&](std::size_t row) {
    const int y = static_cast<int>(row);
    for (int x = 0; x < image.width; ++x) {
      if (!counts(mask, x, y)) continue;
      rows[row].add(image.rgb(x, y), reference.rgb(x, y));
      if (!flip.data.empty()) rows[row].flip += flip.at(x, y, 0);
    }
  });
  ErrorSums total;
  for (const ErrorSums& row : rows) total.add(row);
  return total;
}

}  // namespace

double psnr_of(double rmse_clamped) {
  return rmse_clamped > 0 ? -20 * std::log10(rmse_clamped) : std::numeric_limits<double>::infinity();
}

Comparison compare_images(const Image& image, const Image& reference, const CompareOptions& options) {
  require_comparable(image, reference, options.mask);
  const Image flip = options.flip ? flip_difference(image, reference) : Image();
  const ErrorSums sums = sum_errors(image, reference, options.mask, flip);
  if (sums.pixels == 0) throw Error("compare: expected pixels above .5 in the mask, found none");

  const double values = 3 * static_cast<double>(sums.pixels);
  Comparison result;
  result.pixels = sums.pixels;
  result.rmse = std::sqrt(sums.squared / values);
  result.rmse_clamped = std::sqrt(sums.squared_clamped / values);
  result.psnr = psnr_of(result.rmse_clamped);
  result.relative_mse = sums.relative / values;
  result.bias = sums.signed_error / values;
  result.mean_error = sums.absolute / values;
  result.max_error = sums.largest;
  result.flip = sums.flip / static_cast<double>(sums.pixels);
  result.worst = find_worst(image, reference, options.mask, options.worst_pixels);
  return result;
}

Image difference_picture(const Image& image, const Image& reference, const Image* mask, float gain) {
  require_comparable(image, reference, mask);
  Image picture(image.width, image.height, 3);
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) {
      if (!counts(mask, x, y)) continue;
      const Rgb d = image.rgb(x, y) - reference.rgb(x, y);
      picture.set_rgb(x, y, Rgb{std::abs(d.r), std::abs(d.g), std::abs(d.b)} * gain);
    }
  return picture;
}

}  // namespace redmap
