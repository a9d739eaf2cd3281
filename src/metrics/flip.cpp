// LDR-FLIP in the order of the paper (Andersson et al. 2020): section 4.1 colour, 4.2 features, 4.3 both together.
#include "metrics/flip.h"

#include <algorithm>
#include <cmath>

#include "base/parallel.h"
#include "metrics/color_spaces.h"
#include "metrics/separable_filter.h"

namespace redmap {

namespace {

// Section 4.1.3: exponent of the colour difference, and where the compression of large differences starts, as parts of
// the largest difference and of the result.
constexpr float kColorExponent = 0.7f, kLargeDifference = 0.4f, kLargeResult = 0.95f;
// Section 4.2: width of a feature in degrees, and the exponent of the feature difference.
constexpr float kFeatureWidthDegrees = 0.082f, kFeatureExponent = 0.5f;

/// Table 1: contrast sensitivity to one opponent channel, in the frequency domain a sum of two Gaussians.
struct Sensitivity {
  float a1, b1, a2, b2;
};
constexpr Sensitivity kAchromatic{1, 0.0047f, 0, 1e-5f}, kRedGreen{1, 0.0053f, 0, 1e-5f},
    kBlueYellow{34.1f, 0.04f, 13.5f, 0.025f};

/// A sampled function of the offset in pixels, -radius to radius.
template <typename Function>
Kernel sample_kernel(int radius, const Function& function) {
  Kernel kernel;
  for (int x = -radius; x <= radius; ++x) kernel.push_back(function(static_cast<float>(x)));
  return kernel;
}

float sum(const Kernel& kernel) {
  float total = 0;
  for (const float weight : kernel) total += weight;
  return total;
}

/// Equation 4 in two dimensions and pixels: its first or second Gaussian, without the amplitude.
Kernel sensitivity_kernel(float b, int radius, float pixels_per_degree) {
  return sample_kernel(radius, [&](float x) {
    const float degrees = x / pixels_per_degree;
    return std::exp(-kPi * kPi * degrees * degrees / b);
  });
}

/// One opponent channel as the eye sees it. Each Gaussian is separable, and the two together have weight one.
std::vector<float> filter_channel(const Plane& channel, const Sensitivity& s, int radius, float pixels_per_degree) {
  const Kernel first = sensitivity_kernel(s.b1, radius, pixels_per_degree);
  Plane result = filter_separable(channel, first, first);
  const float first_weight = s.a1 * std::sqrt(kPi / s.b1), first_sum = sum(first) * sum(first);
  if (s.a2 == 0) {
    for (float& value : result.data) value /= first_sum;
    return result.data;
  }
  const Kernel second = sensitivity_kernel(s.b2, radius, pixels_per_degree);
  const Plane added = filter_separable(channel, second, second);
  const float second_weight = s.a2 * std::sqrt(kPi / s.b2), second_sum = sum(second) * sum(second);
  const float total = first_weight * first_sum + second_weight * second_sum;
  for (std::size_t i = 0; i < result.data.size(); ++i)
    result.data[i] = (first_weight * result.data[i] + second_weight * added.data[i]) / total;
  return result.data;
}

/// Section 4.1.1: the picture in opponent channels, still unfiltered.
std::vector<Plane> opponent_channels(const Image& image) {
  std::vector<Plane> planes(3, Plane(image.width, image.height));
  parallel_for(static_cast<std::size_t>(image.height), [&](std::size_t y) {
    for (int x = 0; x < image.width; ++x) {
      const Vec3 c = linear_to_ycxcz(clamped(image.rgb(x, static_cast<int>(y))));
      for (int channel = 0; channel < 3; ++channel) planes[channel].at(x, static_cast<int>(y)) = c[channel];
    }
  });
  return planes;
}

/// Sections 4.1.1 and 4.1.2: what the eye sees of the picture, in Hunt-adjusted CIELab.
std::vector<Vec3> perceived_colors(const std::vector<Plane>& opponent, float pixels_per_degree) {
  // Three standard deviations of the widest Gaussian of all channels.
  const float widest = std::sqrt(kBlueYellow.b1 / (2 * kPi * kPi));
  const int radius = static_cast<int>(std::ceil(3 * widest * pixels_per_degree));
  const std::vector<float> y = filter_channel(opponent[0], kAchromatic, radius, pixels_per_degree);
  const std::vector<float> cx = filter_channel(opponent[1], kRedGreen, radius, pixels_per_degree);
  const std::vector<float> cz = filter_channel(opponent[2], kBlueYellow, radius, pixels_per_degree);
  std::vector<Vec3> colors(y.size());
  const auto width = static_cast<std::size_t>(opponent[0].width);
  parallel_for(y.size() / width, [&](std::size_t row) {
    for (std::size_t i = row * width; i < (row + 1) * width; ++i)
      colors[i] = hunt_adjusted(linear_to_lab(clamped(ycxcz_to_linear({y[i], cx[i], cz[i]}))));
  });
  return colors;
}

/// Section 4.1.3: the difference of two colours, equation 5, compressed to [0, 1].
float color_difference(Vec3 a, Vec3 b) {
  static const float largest = std::pow(
      hyab_distance(hunt_adjusted(linear_to_lab({0, 1, 0})), hunt_adjusted(linear_to_lab({0, 0, 1}))), kColorExponent);
  const float difference = std::pow(hyab_distance(a, b), kColorExponent), knee = kLargeDifference * largest;
  if (difference < knee) return kLargeResult / knee * difference;
  return kLargeResult + (difference - knee) / (largest - knee) * (1 - kLargeResult);
}

/// Makes the positive weights sum to one and the negative ones to minus one.
void normalize_signs(Kernel& kernel) {
  float positive = 0, negative = 0;
  for (const float weight : kernel) (weight > 0 ? positive : negative) += weight;
  for (float& weight : kernel) weight /= weight > 0 ? positive : -negative;
}

/// How much of an edge and of a point each pixel is.
struct Features {
  std::vector<float> edge, point;
};

/// Section 4.2: first and second derivatives of a Gaussian, along x and along y, on the achromatic channel.
Features detect_features(const Plane& achromatic, float pixels_per_degree) {
  Plane luminance = achromatic;
  for (float& value : luminance.data) value = (value + 16) / 116;  // to [0, 1]
  const float deviation = 0.5f * kFeatureWidthDegrees * pixels_per_degree, variance = deviation * deviation;
  const int radius = static_cast<int>(std::ceil(3 * deviation));
  const auto gaussian = [&](float x) { return std::exp(-x * x / (2 * variance)); };
  Kernel smooth = sample_kernel(radius, gaussian);
  const float total = sum(smooth);
  for (float& weight : smooth) weight /= total;

  const auto magnitude = [&](Kernel derivative) {
    normalize_signs(derivative);
    const Plane along_x = filter_separable(luminance, derivative, smooth);
    const Plane along_y = filter_separable(luminance, smooth, derivative);
    std::vector<float> lengths(luminance.data.size());
    for (std::size_t i = 0; i < lengths.size(); ++i) lengths[i] = std::hypot(along_x.data[i], along_y.data[i]);
    return lengths;
  };
  return {magnitude(sample_kernel(radius, [&](float x) { return -x * gaussian(x); })),
          magnitude(sample_kernel(radius, [&](float x) { return (x * x / variance - 1) * gaussian(x); }))};
}

/// The two pictures' features at pixel `i` against each other, in [0, 1].
float feature_difference(const Features& a, const Features& b, std::size_t i) {
  const float larger = std::max(std::abs(a.edge[i] - b.edge[i]), std::abs(a.point[i] - b.point[i]));
  return std::pow(larger / std::sqrt(2.0f), kFeatureExponent);
}

}  // namespace

Image flip_difference(const Image& image, const Image& reference, const FlipOptions& options) {
  const float pixels_per_degree = options.pixels_per_degree;
  const std::vector<Plane> image_channels = opponent_channels(image), reference_channels = opponent_channels(reference);
  const std::vector<Vec3> image_colors = perceived_colors(image_channels, pixels_per_degree);
  const std::vector<Vec3> reference_colors = perceived_colors(reference_channels, pixels_per_degree);
  const Features image_features = detect_features(image_channels[0], pixels_per_degree);
  const Features reference_features = detect_features(reference_channels[0], pixels_per_degree);

  // Section 4.3: differences in features amplify differences in colour.
  Image result(image.width, image.height, 1);
  const auto width = static_cast<std::size_t>(image.width);
  parallel_for(static_cast<std::size_t>(image.height), [&](std::size_t row) {
    for (std::size_t i = row * width; i < (row + 1) * width; ++i) {
      const float color = color_difference(image_colors[i], reference_colors[i]);
      result.data[i] = std::pow(color, 1 - feature_difference(image_features, reference_features, i));
    }
  });
  return result;
}

}  // namespace redmap
