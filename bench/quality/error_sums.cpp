#include "error_sums.h"

#include <algorithm>
#include <cmath>

namespace redmap::bench {

namespace {

double mean_square(Rgb d) { return (d.r * d.r + d.g * d.g + d.b * d.b) / 3.0; }

Rgb clamp_unit(Rgb c) {
  return {std::clamp(c.r, 0.0f, 1.0f), std::clamp(c.g, 0.0f, 1.0f), std::clamp(c.b, 0.0f, 1.0f)};
}

}  // namespace

double ErrorSums::root(const Sum& sum) { return sum.count ? std::sqrt(sum.squares / sum.count) : 0; }

void ErrorSums::add(const Image& image, const Image& reference, std::span<const PixelClass> classes) {
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) {
      const PixelClass c = classes[static_cast<std::size_t>(y) * image.width + x];
      if (c == PixelClass::kBackground) continue;
      const Rgb value = image.rgb(x, y), truth = reference.rgb(x, y);
      const double square = mean_square(value - truth);
      if (c == PixelClass::kSilhouette) {
        silhouette_.add(square);
        continue;
      }
      const double clamped = mean_square(clamp_unit(value) - clamp_unit(truth));
      interior_.add(square), clamped_.add(clamped);
      if (c == PixelClass::kSeam) seams_.add(square);
      const Rgb difference = value - truth;
      bias_ += (difference.r + difference.g + difference.b) / 3.0;
      pixels_.push_back({truth.r + truth.g + truth.b, static_cast<float>(square), static_cast<float>(clamped)});
    }
}

double ErrorSums::mean_reference() const {
  double sum = 0;
  for (const Pixel& pixel : pixels_) sum += static_cast<double>(pixel.reference);
  return pixels_.empty() ? 0 : sum / (3 * static_cast<double>(pixels_.size()));
}

double ErrorSums::brightest_tenth() const {
  if (pixels_.empty()) return 0;
  std::vector<Pixel> sorted = pixels_;
  const auto tenth = sorted.begin() + sorted.size() * 9 / 10;
  std::nth_element(sorted.begin(), tenth, sorted.end(),
                   [](const Pixel& a, const Pixel& b) { return a.reference < b.reference; });
  Sum sum;
  for (auto pixel = tenth; pixel != sorted.end(); ++pixel) sum.add(pixel->squared_error_clamped);
  return root(sum);
}

double ErrorSums::percentile_95() const {
  if (pixels_.empty()) return 0;
  std::vector<Pixel> sorted = pixels_;
  const auto at = sorted.begin() + sorted.size() * 95 / 100;
  std::nth_element(sorted.begin(), at, sorted.end(),
                   [](const Pixel& a, const Pixel& b) { return a.squared_error < b.squared_error; });
  return std::sqrt(at->squared_error);
}

}  // namespace redmap::bench
