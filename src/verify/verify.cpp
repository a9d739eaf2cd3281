#include "verify/verify.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "bake/baselines.h"
#include "base/error.h"
#include "scene/object_data.h"
#include "verify/conformal.h"

namespace redmap {

namespace {

/// `options` with everything settled. Throws Error on what is out of range.
VerifyOptions settled(VerifyOptions options, const ReductionMap& map) {
  constexpr int kMostSamples = 1 << 20, kMostPixels = 1 << 20;
  if (options.minifications.empty()) options.minifications = verified_minifications(map);
  for (const float minification : options.minifications)
    if (!(minification >= 0.01f && minification <= 4096))
      throw Error("verify: minifications: expected numbers from .01 to 4096, found {}", minification);
  if (options.pixels < 1 || options.pixels > kMostPixels)
    throw Error("verify: pixels: expected 1 to {} for each minification, found {}", kMostPixels, options.pixels);
  if (options.spp < 2 || options.spp > kMostSamples)
    throw Error("verify: samples: expected 2 to {} a pixel, found {}", kMostSamples, options.spp);
  if (!(options.coverage > 0 && options.coverage < 1))
    throw Error("verify: coverage: expected a number between 0 and 1, found {}", options.coverage);
  return options;
}

using Pixels = std::vector<const MeasuredPixel*>;

ErrorRow summarize(double of, const Pixels& pixels, double coverage) {
  ErrorRow row;
  row.of = of, row.pixels = pixels.size();
  std::vector<double> errors, flips;
  for (const MeasuredPixel* pixel : pixels) {
    row.rms += pixel->error * pixel->error, row.mean += pixel->error;
    row.residual += pixel->residual * pixel->residual, row.flip += pixel->flip;
    errors.push_back(pixel->error), flips.push_back(pixel->flip);
  }
  const auto count = static_cast<double>(pixels.size());
  row.rms = std::sqrt(row.rms / count), row.mean /= count;
  row.residual = std::sqrt(row.residual / count), row.flip /= count;
  if (pixels.size() < fewest_cases(coverage)) return row;
  row.bound = conformal_bound(std::move(errors), coverage);
  row.flip_bound = conformal_bound(std::move(flips), coverage);
  return row;
}

/// The row of `minifications` that a pixel belongs to.
std::size_t row_of(const MeasuredPixel& pixel, std::span<const float> minifications) {
  std::size_t nearest = 0;
  const auto distance = [&](std::size_t i) { return std::abs(std::log2(pixel.pixel.minification / minifications[i])); };
  for (std::size_t i = 1; i < minifications.size(); ++i)
    if (distance(i) < distance(nearest)) nearest = i;
  return nearest;
}

template <typename KeyOf>
std::vector<ErrorRow> rows_by(std::span<const MeasuredPixel> pixels, double coverage, const KeyOf& key_of) {
  std::map<double, Pixels> groups;
  for (const MeasuredPixel& pixel : pixels) groups[key_of(pixel)].push_back(&pixel);
  std::vector<ErrorRow> rows;
  for (const auto& [key, group] : groups) rows.push_back(summarize(key, group, coverage));
  return rows;
}

std::vector<ErrorRow> rows_by_minification(std::span<const MeasuredPixel> pixels, const VerifyOptions& options) {
  return rows_by(pixels, options.coverage, [&](const MeasuredPixel& pixel) {
    return static_cast<double>(options.minifications[row_of(pixel, options.minifications)]);
  });
}

MeasureOptions measure_options(const VerifyOptions& options, bool supersampled) {
  return {options.quality, options.spp, supersampled, options.progress, options.cancelled};
}

std::vector<PixelCase> draw(const PixelRenderer& renderer, const ReductionMap& map, const VerifyOptions& options) {
  const auto pixels =
      draw_interior_pixels(renderer, map, {options.quality, options.minifications, options.pixels, options.seed});
  if (pixels.empty())
    throw Error("verify: object '{}': no pixel sees nothing but its interior: expected some at {} to {} texels a pixel",
                renderer.scene().objects.front().name, options.minifications.front(), options.minifications.back());
  return pixels;
}

const MeasuredPixel& worst_of(std::span<const MeasuredPixel> pixels) {
  return *std::max_element(pixels.begin(), pixels.end(),
                           [](const MeasuredPixel& a, const MeasuredPixel& b) { return a.error < b.error; });
}

/// Bounds by minification and by the angle of the half vector, which together cover what they say.
void bound_kinds(const VerifyReport& report, const VerifyOptions& options, Certificate& certificate) {
  const int kinds = static_cast<int>(options.minifications.size()) * kHalfAngleKinds;
  // Pixels were drawn one minification after the other: their order within each is random, and so is who is even.
  std::vector<ErrorOfKind> errors;
  for (const MeasuredPixel& pixel : report.pixels)
    errors.push_back({pixel.error, static_cast<int>(row_of(pixel, options.minifications)) * kHalfAngleKinds +
                                       half_angle_kind(pixel.pixel.half_degrees)});
  if (errors.size() / 2 < fewest_cases(options.coverage)) return;
  const ConformalBounds bounds(errors, kinds, options.coverage);
  for (Certificate::Row& row : certificate.rows) {
    const auto at = std::find(options.minifications.begin(), options.minifications.end(), row.minification);
    const int first = static_cast<int>(at - options.minifications.begin()) * kHalfAngleKinds;
    for (int kind = 0; kind < kHalfAngleKinds; ++kind)
      row.bound_of_kind[kind] = static_cast<float>(bounds.bound(first + kind));
  }
}

Certificate certify(const PixelRenderer& renderer, const ReductionMap& map, const VerifyReport& report,
                    const VerifyOptions& options) {
  Certificate certificate;
  certificate.coverage = static_cast<float>(options.coverage);
  certificate.quality = name_of(options.quality);
  certificate.samples = options.spp;
  certificate.residual = static_cast<float>(report.all.residual);
  for (const ErrorRow& row : report.by_minification)
    if (row.bound)
      certificate.rows.push_back({static_cast<float>(row.of),
                                  static_cast<int>(row.pixels),
                                  static_cast<float>(row.rms),
                                  static_cast<float>(row.mean),
                                  static_cast<float>(*row.bound),
                                  {}});
  bound_kinds(report, options, certificate);
  const MeasuredPixel& worst = worst_of(report.pixels);
  certificate.worst = {worst.pixel.position, worst.pixel.uv, worst.pixel.minification, static_cast<float>(worst.error)};
  if (!options.stages) return certificate;
  const Diagnosis diagnosis = diagnose(renderer, map, report.pixels, report.shares);
  certificate.weakest = kStageNames[static_cast<int>(diagnosis.weakest)];
  certificate.reason = diagnosis.reason;
  return certificate;
}

template <typename Bound>
std::optional<double> largest(const std::vector<ErrorRow>& rows, const Bound& bound) {
  std::optional<double> largest;
  for (const ErrorRow& row : rows)
    if (bound(row)) largest = std::max(largest.value_or(0), *bound(row));
  return largest;
}

}  // namespace

std::vector<float> verified_minifications(const ReductionMap& map) {
  constexpr float kFirst = 0.5f;
  constexpr int kWidestPart = 32;
  std::vector<float> minifications{kFirst};
  while (minifications.back() * 2 * kWidestPart <= static_cast<float>(map.size))
    minifications.push_back(2 * minifications.back());
  return minifications;
}

VerifyReport verify(const Object& object, std::shared_ptr<const ReductionMap> map, const VerifyOptions& asked) {
  const VerifyOptions options = settled(asked, *map);
  const PixelRenderer renderer(object);
  const std::vector<PixelCase> pixels = draw(renderer, *map, options);
  const bool supersampled = is_supersampled(object, Method::kMap, {map, nullptr, nullptr});
  std::optional<StageMeter> stages;
  if (options.stages && !supersampled) stages.emplace(object, map, places_of(renderer, pixels));

  VerifyReport report;
  report.pixels = measure_pixels(renderer, pixels, make_map_shading(object.shader, map, object.surface),
                                 stages ? &*stages : nullptr, measure_options(options, supersampled));
  if (report.pixels.empty()) throw Error("verify: object '{}': no pixel was measured", object.name);
  Pixels all;
  for (const MeasuredPixel& pixel : report.pixels) all.push_back(&pixel);
  report.all = summarize(0, all, options.coverage);
  report.by_minification = rows_by_minification(report.pixels, options);
  report.by_level = rows_by(report.pixels, options.coverage,
                            [](const MeasuredPixel& pixel) { return static_cast<double>(pixel.pixel.level); });
  report.shares = share_error(report.pixels);
  report.certificate = certify(renderer, *map, report, options);
  return report;
}

std::vector<ErrorRow> verify_averaged_material(const Object& object, const ReductionMap& map,
                                               const VerifyOptions& asked) {
  const VerifyOptions options = settled(asked, map);
  const PixelRenderer renderer(object);
  const std::vector<PixelCase> pixels = draw(renderer, map, options);
  const auto parameters =
      std::make_shared<const Pyramid<float>>(build_parameter_pyramid(*object.surface, *object.shader, map.size));
  std::shared_ptr<const Pyramid<float>> slopes;
  if (object.shader->info().perturbs_normals)
    slopes = std::make_shared<const Pyramid<float>>(build_slope_pyramid(*object.surface, *object.shader, map.size));
  require_parameters(object, {nullptr, parameters, nullptr, slopes});
  const auto measured = measure_pixels(renderer, pixels, make_parameters_shading(object.shader, parameters, slopes),
                                       nullptr, measure_options(options, false));
  return rows_by_minification(measured, options);
}

std::optional<double> largest_error_bound(const std::vector<ErrorRow>& rows) {
  return largest(rows, [](const ErrorRow& row) { return row.bound; });
}

std::optional<double> largest_flip_bound(const std::vector<ErrorRow>& rows) {
  return largest(rows, [](const ErrorRow& row) { return row.flip_bound; });
}

}  // namespace redmap
