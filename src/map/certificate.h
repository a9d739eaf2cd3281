// What a map says about its own error: pixels rendered by brute force and through it (docs/verify.md).
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "base/vec.h"

namespace redmap {

/// Kinds of pixels that a certificate tells apart beside their minification: by the angle between the normal and the
/// half vector, in degrees. Most highlights end within 10 degrees of it, nearly all within 30.
inline constexpr std::array<float, 2> kHalfDegreesOfKind{10, 30};
inline constexpr int kHalfAngleKinds = 3;
inline int half_angle_kind(float half_degrees) {
  return half_degrees < kHalfDegreesOfKind[0] ? 0 : half_degrees < kHalfDegreesOfKind[1] ? 1 : 2;
}

/// All errors are root mean squares over R, G and B in linear light, unclamped, under one light of irradiance pi: white
/// Lambert that faces it is 1.
struct Certificate {
  /// Pixels of about one minification (root of pixel footprint area over texel area, within a factor of root 2).
  struct Row {
    float minification = 0;
    int pixels = 0;
    float rms_error = 0, mean_error = 0;
    float bound = 0;                                     ///< that new pixels keep with a probability of `coverage`
    std::array<float, kHalfAngleKinds> bound_of_kind{};  ///< the same, by the angle of their half vector
  };
  struct Place {
    Vec3 position;  ///< object space
    Vec2 uv;
    float minification = 0, error = 0;
  };

  float coverage = 0;
  std::string quality;  ///< of the frames: default or fast
  int samples = 0;      ///< of the shader itself in every pixel
  float residual = 0;   ///< of these, root mean square
  std::vector<Row> rows;
  Place worst;
  std::string weakest;  ///< the stage that most of the error comes from: fit, texels, filter or normals
  std::string reason;   ///< half a sentence for people
};

/// What a pixel is certified to be off by at most: nothing where its minification is beyond the rows.
std::optional<float> bound_of(const Certificate& certificate, float minification, float half_degrees);

/// The largest bound of its rows: 0 without any.
float largest_bound(const Certificate& certificate);

}  // namespace redmap
