// Errors against a reference, pooled over views, with interior, seam and silhouette pixels apart.
#pragma once

#include <span>
#include <vector>

#include "base/image.h"
#include "render/renderer.h"

namespace redmap::bench {

class ErrorSums {
 public:
  /// Adds a view. `classes` has one entry a pixel.
  void add(const Image& image, const Image& reference, std::span<const PixelClass> classes);

  double interior() const { return root(interior_); }
  double interior_clamped() const { return root(clamped_); }
  double seams() const { return root(seams_); }
  double silhouette() const { return root(silhouette_); }
  double bias() const { return interior_.count ? bias_ / interior_.count : 0; }
  /// Clamped error over the pixels whose reference is in the brightest tenth of the interior.
  double brightest_tenth() const;
  double percentile_95() const;
  /// Mean of the reference over R, G and B of the interior.
  double mean_reference() const;
  double interior_pixels() const { return interior_.count; }

 private:
  struct Sum {
    double squares = 0, count = 0;
    void add(double square) { squares += square, ++count; }
  };
  struct Pixel {
    float reference, squared_error, squared_error_clamped;
  };
  static double root(const Sum& sum);

  Sum interior_, clamped_, seams_, silhouette_;
  double bias_ = 0;
  std::vector<Pixel> pixels_;  ///< of the interior
};

}  // namespace redmap::bench
