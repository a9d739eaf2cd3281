// How far pictures are from a reference: errors in linear light, perceived difference, flicker over frames.
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <vector>

#include "base/image.h"

namespace redmap {

struct CompareOptions {
  const Image* mask = nullptr;  ///< same size; only pixels above .5 in its first channel count
  int worst_pixels = 5;         ///< how many to report
  bool flip = true;             ///< FLIP is the slow part
};

struct PixelDifference {
  int x = 0, y = 0;
  Rgb image, reference;
  double error = 0;  ///< root mean square over R, G and B
};

/// Over R, G and B of all pixels that count, in linear light. Alpha does not count, grey counts as R = G = B.
struct Comparison {
  std::size_t pixels = 0;                ///< that count
  double rmse = 0, rmse_clamped = 0;     ///< root mean square error; beside it that of the values clamped to [0, 1]
  double psnr = 0;                       ///< decibels of `rmse_clamped` against white; infinite if that is zero
  double relative_mse = 0;               ///< mean of squared error over (squared reference + kRelativeEpsilon)
  double bias = 0;                       ///< mean of image - reference
  double mean_error = 0, max_error = 0;  ///< of the absolute error of single channels
  double flip = 0;                       ///< mean LDR-FLIP in [0, 1], computed over the whole pictures; see flip.h
  std::vector<PixelDifference> worst;    ///< largest error first
};

/// Keeps the relative error of black finite; the value of Rousselle et al. 2011, "Adaptive Sampling and Reconstruction
/// using Greedy Error Minimization", and of most comparisons since.
inline constexpr double kRelativeEpsilon = 0.01;

/// Throws Error if the sizes differ, a value is not finite, even where it does not count, or no pixel counts.
Comparison compare_images(const Image& image, const Image& reference, const CompareOptions& options = {});

/// Flicker of a sequence: root mean square of (I_t - R_t) - (I_t-1 - R_t-1) over R, G, B and all pixels that count in
/// both frames. What moves in the reference too is no flicker.
class FlickerMeter {
 public:
  /// The next frame. Throws Error if sizes differ, also from the frame before.
  void add(const Image& image, const Image& reference, const Image* mask = nullptr);
  /// So far; zero before the second frame.
  double flicker() const;
  /// Pixels, summed over pairs of frames, that counted.
  std::size_t pixels() const { return pixels_; }

 private:
  Image previous_error_;               ///< RGB
  std::vector<bool> previous_counts_;  ///< which pixels
  double squared_sum_ = 0;
  std::size_t pixels_ = 0;
};

struct SequenceComparison {
  Comparison all;               ///< as if all frames were one picture; `worst` is that of the worst frame
  std::size_t worst_frame = 0;  ///< place in the sequence of the frame with the largest RMSE
  double flicker = 0;
  std::size_t flicker_pixels = 0;
};

/// Reads and compares frame by frame. `masks` is empty, or one for each frame. Throws Error.
SequenceComparison compare_sequences(std::span<const std::filesystem::path> images,
                                     std::span<const std::filesystem::path> references,
                                     std::span<const std::filesystem::path> masks, const CompareOptions& options = {});

/// A picture of the absolute difference: each channel times `gain`. Where `mask` is given, pixels that do not count are
/// black.
Image difference_picture(const Image& image, const Image& reference, const Image* mask = nullptr, float gain = 1);

}  // namespace redmap
