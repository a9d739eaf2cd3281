#include "export/material_fit.h"

#include <ceres/tiny_solver.h>
#include <ceres/tiny_solver_autodiff_function.h>

#include <algorithm>
#include <optional>

#include "base/parallel.h"
#include "base/random.h"
#include "shader/shading_frames.h"

namespace redmap {

namespace {

constexpr std::size_t kSamples = 1200;
// Half vectors this close to the normal are still told apart: a quarter of the narrowest highlight that glTF's viewers
// draw.
constexpr float kLeastAngle = 0.003f;
// Between light and half vector: light and viewer are up to 90 degrees apart. Lobes about the mirror direction and
// lobes about the half vector part beyond, and a fit to both ends would be good at neither (docs/export.md).
constexpr float kWidestDifference = 0.25f * kPi;
constexpr float kLeastCosine = 0.03f;  // of light and viewer
// Extensions of glTF have to earn their keep.
constexpr float kGain = 0.8f, kGoodWithout = 0.01f;

/// Directions, what is reflected in them, and what each counts.
struct Samples {
  DirectionPairs pairs;
  std::vector<double> weights;
  Planes<3> radiance;
  double scale = 1;  ///< of residuals: one over the RMS
};

/// Half of the half vectors are spread evenly, half on a logarithmic scale of angles to the normal; weights undo it.
Samples draw_samples(std::uint64_t seed) {
  Random random(seed);
  Samples samples;
  samples.pairs.resize(kSamples);
  const float range = std::log(0.5f * kPi / kLeastAngle);
  while (samples.weights.size() < kSamples) {
    const bool even = random.next_float() < 0.5f;
    const float number = random.next_float();
    const float angle = even ? std::acos(number) : kLeastAngle * std::exp(range * number);
    const float difference = kWidestDifference * random.next_float();
    const float azimuth = 2 * kPi * random.next_float(), turn = 2 * kPi * random.next_float();
    const Vec3 half{std::sin(angle) * std::cos(azimuth), std::sin(angle) * std::sin(azimuth), std::cos(angle)};
    const Frame about = make_frame(half, {1, 0, 0});
    const Vec3 side = about.x * std::cos(turn) + about.y * std::sin(turn);
    const Vec3 light = half * std::cos(difference) + side * std::sin(difference);
    const Vec3 viewer = half * std::cos(difference) - side * std::sin(difference);
    if (light.z < kLeastCosine || viewer.z < kLeastCosine) continue;
    const std::size_t i = samples.weights.size();
    samples.pairs.to_light.set(i, light), samples.pairs.to_viewer.set(i, viewer);
    const float evenly = std::sin(angle), logarithmic = angle > kLeastAngle ? 1 / (angle * range) : 0;
    samples.weights.push_back(static_cast<double>(2 * evenly / (evenly + logarithmic)));
  }
  return samples;
}

void ask(const BoundPatterns& patterns, std::size_t index, Samples& samples) {
  patterns.radiance_one(index, samples.pairs, samples.radiance);
  double sum = 0;
  for (std::size_t i = 0; i < kSamples; ++i)
    for (int c = 0; c < 3; ++c)
      sum += samples.weights[i] * static_cast<double>(samples.radiance[c][i]) *
             static_cast<double>(samples.radiance[c][i]);
  samples.scale = sum > 0 ? 1 / std::sqrt(sum) : 1;
}

template <typename T>
T logistic(const T& x) {
  using std::exp;
  return 1.0 / (1.0 + exp(-x));
}
double inverse_logistic(double y) {
  const double inside = std::clamp(y, 1e-4, 1 - 1e-4);
  return std::log(inside / (1 - inside));
}

/// What a fit may use beside glTF's core.
struct Parts {
  bool specular = false, coat = false, anisotropy = false;
  bool metal = true;  ///< not where light passes through: metals let none
};

/// Numbers within their bounds, of any.
template <typename T>
GltfNumbers<T> bounded(const T* x, Parts parts) {
  constexpr double kLeast = kGltfLeastRoughness;
  GltfNumbers<T> p;
  for (int i = 0; i < kGltfReflectanceNumbers; ++i) p[i] = logistic(x[i]);
  for (int i : {4, 10}) p[i] = kLeast + (1 - kLeast) * p[i];
  if (!parts.specular) p[5] = T(1.0), p[6] = p[7] = p[8] = T(static_cast<double>(kGltfReflectance));
  if (!parts.metal) p[3] = T(0.0);
  if (!parts.coat) p[9] = T(0.0);
  if (!parts.anisotropy) p[11] = T(0.0);
  p[12] = x[12];
  return p;
}

struct Residuals {
  const Samples* samples;
  Parts parts;
  int NumResiduals() const { return 3 * static_cast<int>(kSamples); }
  template <typename T>
  bool operator()(const T* x, T* residuals) const {
    const GltfNumbers<T> p = bounded(x, parts);
    for (std::size_t i = 0; i < kSamples; ++i) {
      const GltfAngles at(samples->pairs.to_light.get(i), samples->pairs.to_viewer.get(i));
      const std::array<T, 3> radiance = gltf_radiance(p, at);
      const double scale = samples->scale * std::sqrt(samples->weights[i]);
      for (int c = 0; c < 3; ++c)
        residuals[3 * i + c] = (radiance[c] - static_cast<double>(samples->radiance[c][i])) * scale;
    }
    return true;
  }
};
using Function = ceres::TinySolverAutoDiffFunction<Residuals, Eigen::Dynamic, kGltfReflectanceNumbers, double>;

float error_of(const GltfNumbers<double>& p, const Samples& samples) {
  double sum = 0;
  for (std::size_t i = 0; i < kSamples; ++i) {
    const auto radiance = gltf_radiance(p, {samples.pairs.to_light.get(i), samples.pairs.to_viewer.get(i)});
    for (int c = 0; c < 3; ++c) {
      const double difference = radiance[c] - static_cast<double>(samples.radiance[c][i]);
      sum += samples.weights[i] * difference * difference;
    }
  }
  return static_cast<float>(std::sqrt(sum) * samples.scale);
}

/// Colour of the diffuse part, roughly: the median over directions, which leaves the highlight out.
std::array<double, 3> diffuse_guess(const Samples& samples) {
  std::array<double, 3> guess;
  for (int c = 0; c < 3; ++c) {
    std::vector<double> albedo;
    for (std::size_t i = 0; i < kSamples; ++i)
      albedo.push_back(static_cast<double>(kPi * samples.radiance[c][i] / samples.pairs.to_light[2][i]));
    std::nth_element(albedo.begin(), albedo.begin() + kSamples / 2, albedo.end());
    guess[c] = albedo[kSamples / 2];
  }
  return guess;
}

struct Start {
  double metallic, roughness, reflectance;
};
constexpr Start kStarts[] = {{0.05, 0.1, 0.3}, {0.05, 0.25, 0.1}, {0.05, 0.5, 0.05}, {0.9, 0.2, 0.5}, {0.9, 0.5, 0.5}};

GltfNumbers<double> solve(const Samples& samples, const Start& start, double rotation, Parts parts) {
  const std::array<double, 3> diffuse = diffuse_guess(samples);
  Eigen::Matrix<double, kGltfReflectanceNumbers, 1> x;
  for (int c = 0; c < 3; ++c) x[c] = inverse_logistic(diffuse[c]), x[6 + c] = inverse_logistic(start.reflectance);
  x[3] = inverse_logistic(start.metallic), x[4] = inverse_logistic(start.roughness), x[5] = inverse_logistic(0.8);
  x[9] = inverse_logistic(0.5), x[10] = inverse_logistic(0.5 * start.roughness);
  x[11] = inverse_logistic(0.5), x[12] = rotation;
  const Residuals residuals{&samples, parts};
  const Function function(residuals);
  ceres::TinySolver<Function> solver;
  constexpr int kIterations = 150;
  solver.options.max_num_iterations = kIterations;
  solver.Solve(function, &x);
  return bounded(x.data(), parts);
}

struct Best {
  GltfNumbers<double> numbers{};
  float error = 0;
};
Best best_of_starts(const Samples& seen, Parts parts) {
  constexpr double kTurn = 0.25 * kPi;  // an eighth of the circle: no start is farther from its solution than half that
  std::optional<Best> best;
  for (const Start& start : kStarts)
    for (int turn = 0; turn < (parts.anisotropy ? 4 : 1); ++turn) {
      const GltfNumbers<double> p = solve(seen, start, kTurn * turn, parts);
      const float error = error_of(p, seen);
      if (!best || error < best->error) best = Best{p, error};
    }
  return *best;
}

/// Whether what is reflected depends on more than the angles between light, viewer and normal.
bool has_grain(const BoundPatterns& patterns, std::size_t index, const Samples& seen) {
  Samples turned = seen;
  for (Planes<3>* directions : {&turned.pairs.to_light, &turned.pairs.to_viewer})
    for (std::size_t i = 0; i < kSamples; ++i) {
      const Vec3 d = directions->get(i);
      directions->set(i, Vec3{-d.y, d.x, d.z});
    }
  ask(patterns, index, turned);
  double sum = 0;
  for (std::size_t i = 0; i < kSamples; ++i)
    for (int c = 0; c < 3; ++c) {
      const double difference = static_cast<double>(turned.radiance[c][i] - seen.radiance[c][i]) * seen.scale;
      sum += seen.weights[i] * difference * difference;
    }
  return std::sqrt(sum) > static_cast<double>(kGoodWithout);
}

GltfMaterial material_of(const GltfNumbers<double>& p) {
  const auto number = [&](int i) { return static_cast<float>(p[i]); };
  GltfMaterial material;
  material.base_color = {number(0), number(1), number(2)};
  material.metallic = number(3), material.roughness = number(4), material.specular = number(5);
  material.specular_color = Rgb{number(6), number(7), number(8)} * (1 / kGltfReflectance);
  material.coat = number(9), material.coat_roughness = p[9] > 0 ? number(10) : 0;
  material.anisotropy = number(11);
  // A grain has no direction: half a turn is all.
  material.anisotropy_rotation = p[11] > 0 ? static_cast<float>(std::remainder(p[12], static_cast<double>(kPi))) : 0;
  return material;
}

/// Light that passes through replaces part of the diffuse: base colour * transmission is what passes, the rest of the
/// base colour what scatters.
void let_through(Rgb passes, GltfMaterial& material) {
  const float through = (passes.r + passes.g + passes.b) / 3;
  if (through <= 0) return;
  const Rgb scatters = material.base_color * (1 - material.metallic);
  const Rgb all = passes + scatters;
  material.metallic = 0;
  material.base_color = {std::min(1.0f, all.r), std::min(1.0f, all.g), std::min(1.0f, all.b)};
  material.transmission = through / std::max((all.r + all.g + all.b) / 3, 1e-6f);
}

}  // namespace

GltfNumbers<double> numbers_of(const GltfMaterial& m) {
  const auto reflectance = [](float colour) { return std::min(1.0, static_cast<double>(kGltfReflectance * colour)); };
  const auto roughness = [](float r) { return static_cast<double>(std::max(r, kGltfLeastRoughness)); };
  const double through = 1 - static_cast<double>(m.transmission);
  return {static_cast<double>(m.base_color.r) * through,
          static_cast<double>(m.base_color.g) * through,
          static_cast<double>(m.base_color.b) * through,
          static_cast<double>(m.metallic),
          roughness(m.roughness),
          static_cast<double>(m.specular),
          reflectance(m.specular_color.r),
          reflectance(m.specular_color.g),
          reflectance(m.specular_color.b),
          static_cast<double>(m.coat),
          roughness(m.coat_roughness),
          static_cast<double>(m.anisotropy),
          static_cast<double>(m.anisotropy_rotation)};
}

GltfRoughness roughness_of(const SquaredRoughness<double>& squared) {
  const double mean = 0.5 * (squared.xx + squared.yy);
  const double half = std::hypot(0.5 * (squared.xx - squared.yy), squared.xy);
  const double least = std::sqrt(std::clamp(mean - half, 0.0, 1.0)),
               most = std::sqrt(std::clamp(mean + half, 0.0, 1.0));
  const double anisotropy = least < 1 ? std::sqrt((most - least) / (1 - least)) : 0;
  return {static_cast<float>(std::sqrt(least)), static_cast<float>(anisotropy),
          static_cast<float>(0.5 * std::atan2(2 * squared.xy, squared.xx - squared.yy))};
}

MaterialFit fit_material(const BoundPatterns& patterns, std::size_t index) {
  constexpr std::uint64_t kSeen = 1, kHeldOut = 2;  // any two
  Samples seen = draw_samples(kSeen), held_out = draw_samples(kHeldOut);
  ask(patterns, index, seen), ask(patterns, index, held_out);
  Planes<3> transmittance, emission;
  patterns.transmittance(transmittance), patterns.emission(emission);
  const Rgb passes = transmittance.rgb(index);
  Parts parts;
  parts.metal = passes == Rgb{};
  Best best = best_of_starts(seen, parts);
  const auto try_with = [&](bool Parts::*part) {
    if (best.error <= kGoodWithout) return;
    Parts more = parts;
    more.*part = true;
    const Best found = best_of_starts(seen, more);
    if (found.error < kGain * best.error) best = found, parts = more;
  };
  if (has_grain(patterns, index, seen)) try_with(&Parts::anisotropy);
  try_with(&Parts::specular);
  try_with(&Parts::coat);
  MaterialFit fit{material_of(best.numbers), 0};
  let_through(passes, fit.material);
  fit.material.emission = emission.rgb(index);
  fit.error = error_of(numbers_of(fit.material), held_out);
  return fit;
}

std::vector<MaterialFit> fit_basis(const ReductionMap& map, const Shader& shader) {
  const auto patterns = bind_in_frames(shader, basis_points(map), basis_frames(map));
  std::vector<MaterialFit> fits(map.basis.size());
  parallel_for(fits.size(), [&](std::size_t i) { fits[i] = fit_material(*patterns, i); });
  return fits;
}

}  // namespace redmap
