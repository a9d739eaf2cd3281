// Sampling reflectances: every bound pattern becomes a vector of numbers (paper, section 4.2.1, the V_i).
#pragma once

#include <optional>
#include <vector>

#include "analysis/directions.h"
#include "base/surface_points.h"
#include "shader/shader.h"

namespace redmap {

/// The sampled reflectances of some places: `rows` numbers each, row by row, so that places lie side by side.
struct SampledReflectances {
  std::size_t places = 0, stride = 0;
  int rows = 0;
  LaneVector<float> values;

  const float* row(int r) const { return values.data() + r * stride; }
  float* row(int r) { return values.data() + r * stride; }
};

/// Values from here on are as unsound as infinity: sums of their squares overflow (2^60, about 1e18).
inline constexpr float kUnsoundValue = 0x1p60f;
/// The first place with a value that is NaN, infinite or beyond kUnsoundValue; nothing if all are sound.
std::optional<std::size_t> find_unsound_place(const SampledReflectances& sampled);

/// Asks a shader: red, green and blue of each reflection sample, then of the transmittance (zero where the shader does
/// not transmit), then of the emission if the shader emits.
class ReflectanceSampler {
 public:
  /// `directions`: of the reflection samples.
  explicit ReflectanceSampler(const ShaderInfo& shader, DirectionPairs directions = reflection_samples());
  /// Numbers a place: 3 a direction, 3 of the transmittance, and 3 more if the shader emits.
  int rows() const;
  const DirectionPairs& directions() const { return directions_; }
  /// Safe to call from several threads, each with its own `out`.
  void sample(const BoundPatterns& patterns, SampledReflectances& out) const;

 private:
  DirectionPairs directions_;
  bool transmits_, emits_;
};

/// Scales that bring every row to unit RMS, so that a highlight counts as much as a diffuse colour. Without them one
/// bright row decides alone (docs/bake.md).
class RowScaling {
 public:
  void add(const SampledReflectances& sampled);
  std::size_t places() const { return places_; }
  /// 1 / RMS a row. Rows that were zero take the scale of the brightest: what shows up in them later is not overlooked.
  std::vector<float> scales() const;

 private:
  std::size_t places_ = 0;
  std::vector<double> square_sums_;
};

/// Copies the scaled vector of one place: out[row] = scale[row] * value. `out` has `sampled.rows` floats.
void scaled_reflectance(const SampledReflectances& sampled, std::size_t place, const std::vector<float>& scales,
                        float* out);

}  // namespace redmap
