#include "verify/diagnosis.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "analysis/shading_normal.h"
#include "base/error.h"

namespace redmap {

namespace {

double dot(Rgb a, Rgb b) {
  return static_cast<double>(a.r) * b.r + static_cast<double>(a.g) * b.g + static_cast<double>(a.b) * b.b;
}

/// The pixels with most of the stage's error: enough to tell a property of the shader from an accident.
constexpr std::size_t kLookedAt = 16;

std::vector<PixelCase> worst_of_stage(std::span<const MeasuredPixel> pixels, Stage stage) {
  std::vector<const MeasuredPixel*> sorted;
  for (const MeasuredPixel& pixel : pixels)
    if (pixel.by_map) sorted.push_back(&pixel);
  const auto size = [&](const MeasuredPixel* pixel) { return rms(pixel->stages[static_cast<int>(stage)]); };
  std::stable_sort(sorted.begin(), sorted.end(), [&](auto* a, auto* b) { return size(a) > size(b); });
  std::vector<PixelCase> worst;
  for (std::size_t i = 0; i < std::min(kLookedAt, sorted.size()); ++i) worst.push_back(sorted[i]->pixel);
  return worst;
}

/// How far radiance changes, as a part of itself, where both directions turn about the normal: nil for an isotropic
/// reflectance. The median over the patterns.
double anisotropy_of(const BoundPatterns& patterns) {
  // Off the plane of incidence, and away from the mirror direction, whose peak hides all else.
  constexpr float kLightAngle = 0.6f, kViewerAngle = 0.7f, kBetween = 2.0f;
  constexpr int kTurns = 8;
  const auto direction = [](float angle, float azimuth) {
    return Vec3{std::sin(angle) * std::cos(azimuth), std::sin(angle) * std::sin(azimuth), std::cos(angle)};
  };
  std::vector<double> changes;
  DirectionPairs pairs;
  pairs.resize(kTurns);
  for (int i = 0; i < static_cast<int>(pairs.to_light.stride()); ++i) {
    const float azimuth = static_cast<float>(i) * (2 * kPi / kTurns);
    pairs.to_light.set(i, direction(kLightAngle, azimuth));
    pairs.to_viewer.set(i, direction(kViewerAngle, azimuth + kBetween));
  }
  for (std::size_t p = 0; p < patterns.size(); ++p) {
    Planes<3> radiance;
    patterns.radiance_one(p, pairs, radiance);
    double least = 1e30, most = 0;
    for (int i = 0; i < kTurns; ++i) {
      const double value = rms(radiance.rgb(i));
      least = std::min(least, value), most = std::max(most, value);
    }
    changes.push_back(most > 0 ? 1 - least / most : 0);
  }
  std::nth_element(changes.begin(), changes.begin() + changes.size() / 2, changes.end());
  return changes[changes.size() / 2];
}

/// Part of the patterns whose radiance is about another normal than the shader says.
double hidden_normals_of(const BoundPatterns& patterns) {
  constexpr float kTurned = 0.9998f;  // cosine of .02 rad, twice what the search promises
  const ShadingNormals estimated = estimate_shading_normals(patterns);
  std::size_t hidden = 0;
  for (std::size_t i = 0; i < patterns.size(); ++i) hidden += estimated.found[i] && estimated.normal.get(i).z < kTurned;
  return static_cast<double>(hidden) / static_cast<double>(patterns.size());
}

/// Error of the fit over the truth, both root mean square.
double relative_fit_error(std::span<const MeasuredPixel> pixels) {
  double fit = 0, truth = 0;
  for (const MeasuredPixel& pixel : pixels) {
    if (!pixel.by_map) continue;
    const Rgb error = pixel.stages[static_cast<int>(Stage::kFit)];
    fit += dot(error, error), truth += dot(pixel.truth, pixel.truth);
  }
  return truth > 0 ? std::sqrt(fit / truth) : 0;
}

std::string why_fit(const PixelRenderer& renderer, const ReductionMap& map, std::span<const MeasuredPixel> pixels,
                    std::span<const PixelCase> worst) {
  // What the bake left at its direction samples, at its worst place, and what pixels see on average: if the first is
  // no smaller it says all.
  if (map.residual > relative_fit_error(pixels))
    return fmt::format(
        "the basis is too small: {} reflectances leave a residual of {:.3f}; a tolerance below it takes more",
        map.basis.size(), map.residual);
  const auto patterns = renderer.scene().objects.front().shader->bind(places_of(renderer, worst));
  constexpr double kOften = 0.5, kAnisotropic = 0.1;
  if (!map.hides_frames && hidden_normals_of(*patterns) > kOften)
    return "normals were not found: the shader hides normals of its own in its radiance";
  if (const double change = anisotropy_of(*patterns); change > kAnisotropic)
    return fmt::format(
        "the reflectance is anisotropic: its radiance changes by {:.0f} % as directions turn about the "
        "normal, which the 35 samples of the bake hardly do",
        100 * change);
  return "off-specular: the reflectance differs where none of the 35 direction samples of the bake looks";
}

std::string why_filter(std::span<const MeasuredPixel> pixels) {
  double on_seams = 0, all = 0;
  for (const MeasuredPixel& pixel : pixels) {
    const Rgb filter = pixel.stages[static_cast<int>(Stage::kFilter)];
    all += dot(filter, filter);
    if (pixel.on_seam) on_seams += dot(filter, filter);
  }
  if (on_seams > 0.5 * all) return "the atlas leaks: most of it is in pixels across seams of its charts";
  return "what the lookup averages is not what lies under the pixel";
}

std::string why_normals(std::span<const MeasuredPixel> pixels) {
  double near_highlights = 0, all = 0;
  for (const MeasuredPixel& pixel : pixels) {
    const Rgb normals = pixel.stages[static_cast<int>(Stage::kNormals)];
    all += dot(normals, normals);
    if (pixel.pixel.half_degrees < kHalfDegreesOfKind[1]) near_highlights += dot(normals, normals);
  }
  return fmt::format(
      "one normal and one pair of directions stand for all that turns under a ray's footprint ({:.0f} % of it near "
      "highlights)",
      all > 0 ? 100 * near_highlights / all : 0);
}

}  // namespace

StageShares share_error(std::span<const MeasuredPixel> pixels) {
  StageShares shares{};
  double squared_error = 0;
  std::size_t count = 0;
  for (const MeasuredPixel& pixel : pixels) {
    if (!pixel.by_map) continue;
    // The error that the stages add up to: against the half of the truth that shares their rays.
    Rgb error;
    for (const Rgb& stage : pixel.stages) error += stage;
    squared_error += dot(error, error), ++count;
    for (int s = 0; s < kStages; ++s) {
      shares[s].rms += dot(pixel.stages[s], pixel.stages[s]);
      shares[s].part += dot(pixel.stages[s], error);
    }
  }
  for (StageShare& share : shares) {
    share.rms = count ? std::sqrt(share.rms / (3 * static_cast<double>(count))) : 0;
    share.part = squared_error > 0 ? share.part / squared_error : 0;
  }
  return shares;
}

Diagnosis diagnose(const PixelRenderer& renderer, const ReductionMap& map, std::span<const MeasuredPixel> pixels,
                   const StageShares& shares) {
  const auto largest = std::max_element(shares.begin(), shares.end(),
                                        [](const StageShare& a, const StageShare& b) { return a.part < b.part; });
  Diagnosis diagnosis{static_cast<Stage>(largest - shares.begin()), {}};
  const std::vector<PixelCase> worst = worst_of_stage(pixels, diagnosis.weakest);
  if (worst.empty()) {
    diagnosis.reason = "no pixel was made by the map alone";
    return diagnosis;
  }
  switch (diagnosis.weakest) {
    case Stage::kFit:
      diagnosis.reason = why_fit(renderer, map, pixels, worst);
      break;
    case Stage::kTexels:
      diagnosis.reason = "texels are wider than the detail of the shader: a larger map_size has more of it";
      break;
    case Stage::kFilter:
      diagnosis.reason = why_filter(pixels);
      break;
    case Stage::kNormals:
      diagnosis.reason = why_normals(pixels);
      break;
  }
  return diagnosis;
}

}  // namespace redmap
