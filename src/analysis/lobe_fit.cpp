#include "analysis/lobe_fit.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "analysis/nnls.h"
#include "base/random.h"
#include "lobes/lobe_lanes.h"

namespace redmap {
namespace {

constexpr int kUnknowns = 2 + LobeModel::kWidths;
static_assert(kUnknowns <= kMaxUnknowns);

/// Parts of the peak below this weigh alike.
constexpr float kDarkPart = 1e-3f;
/// Gaussians fainter than this part of the peak are rounding, and would only cost time.
constexpr float kLeastAmplitude = 3e-3f;

/// Directions that are the same in all calls, about a half vector along z.
struct Pair {
  Vec3 to_light, to_viewer;
};
Pair pair_at(float theta_degrees) {
  const float theta = theta_degrees * kPi / 180;
  return {{std::sin(theta), 0, std::cos(theta)}, {-std::sin(theta), 0, std::cos(theta)}};
}

float luminance(Rgb c) { return (c.r + c.g + c.b) / 3; }

/// The reflectance at many normals under one pair of directions.
std::vector<Rgb> evaluate(const BoundPatterns& patterns, std::size_t pattern, Pair pair,
                          std::span<const Vec3> normals) {
  DirectionPairs directions;
  directions.resize(normals.size());
  for (std::size_t i = 0; i < directions.to_light.stride(); ++i) {
    const Frame frame = make_frame(normals[std::min(i, normals.size() - 1)], {1, 0, 0});
    directions.to_light.set(i, frame.to_local(pair.to_light));
    directions.to_viewer.set(i, frame.to_local(pair.to_viewer));
  }
  Planes<3> radiance;
  patterns.radiance_one(pattern, directions, radiance);
  std::vector<Rgb> values(normals.size());
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = radiance.rgb(i);
  return values;
}

/// Offsets from the half vector that are looked at: dense where the narrowest Gaussian is, then a tenth apart.
std::vector<float> offsets() {
  std::vector<float> p{0};
  for (float q = 0.003f; q < 0.96f; q *= 1.1f) p.push_back(q);
  return p;
}
float z_of(float offset) { return std::sqrt(1 - offset * offset); }

/// Non-negative least squares of constant, cosine and Gaussians over the offsets, each weighted by the area of its ring
/// and by how dark it is: what lies around a highlight is seen just as often without it.
void fit_angle(std::span<const float> p, std::span<const Rgb> values, float cosine_of_theta, LobeModel::Angle& angle) {
  double gram[kMaxUnknowns * kMaxUnknowns] = {}, projection[3][kMaxUnknowns] = {};
  float peak = 1e-12f;
  for (const Rgb& value : values) peak = std::max(peak, luminance(value));
  for (std::size_t i = 0; i < p.size(); ++i) {
    const double area = p[i] * ((i + 1 < p.size() ? p[i + 1] : 0.98) - p[i]) + 2e-6;  // the peak counts too
    const double ring = area / (luminance(values[i]) / peak + kDarkPart);
    double basis[kUnknowns] = {1, z_of(p[i]) * cosine_of_theta};
    for (int k = 0; k < LobeModel::kWidths; ++k)
      basis[2 + k] = std::exp(-0.5 * std::pow(p[i] / LobeModel::width(k), 2));
    const double value[3] = {values[i].r, values[i].g, values[i].b};
    for (int a = 0; a < kUnknowns; ++a) {
      for (int b = 0; b < kUnknowns; ++b) gram[a * kMaxUnknowns + b] += ring * basis[a] * basis[b];
      for (int c = 0; c < 3; ++c) projection[c][a] += ring * basis[a] * value[c];
    }
  }
  for (int c = 0; c < 3; ++c) {
    projection[c][0] -= 1e-4 * gram[0];  // what constant and cosine fit equally well is a cosine
    double x[kMaxUnknowns];
    solve_nnls(kUnknowns, gram, projection[c], x);
    angle.constant[c] = static_cast<float>(x[0]), angle.cosine[c] = static_cast<float>(x[1]);
    for (int k = 0; k < LobeModel::kWidths; ++k)
      angle.amplitude[k][c] = x[2 + k] > kLeastAmplitude * peak ? static_cast<float>(x[2 + k]) : 0.0f;
  }
}

float smooth_luminance(const LobeModel::Angle& angle, float facing) {
  float sum = 0;
  for (int c = 0; c < 3; ++c) sum += angle.constant[c] + angle.cosine[c] * std::max(0.0f, facing);
  return sum / 3;
}

/// The offset at which `highlight` has fallen to half its first value; 0 if it does not.
float half_width(std::span<const float> p, std::span<const float> highlight) {
  for (std::size_t i = 1; i < p.size(); ++i)
    if (highlight[i] < 0.5f * highlight[0]) {
      const float fall = highlight[i - 1] - highlight[i];
      return p[i - 1] + (p[i] - p[i - 1]) * (highlight[i - 1] - 0.5f * highlight[0]) / fall;
    }
  return 0;
}

/// Width of the highlight in the plane of incidence over that across it. The geometric mean of both sides takes out
/// what the cosine adds to the one and takes from the other.
float stretch_of(const BoundPatterns& patterns, std::size_t pattern, Pair pair, std::span<const float> p,
                 std::span<const Rgb> across, const LobeModel::Angle& angle) {
  std::vector<Vec3> towards, away;
  for (float q : p) towards.push_back({q, 0, z_of(q)}), away.push_back({-q, 0, z_of(q)});
  const auto value_towards = evaluate(patterns, pattern, pair, towards);
  const auto value_away = evaluate(patterns, pattern, pair, away);
  std::vector<float> in_plane(p.size()), other(p.size());
  for (std::size_t i = 0; i < p.size(); ++i) {
    const auto highlight = [&](Rgb value, Vec3 normal) {
      return std::max(0.0f, luminance(value) - smooth_luminance(angle, dot(normal, pair.to_light)));
    };
    in_plane[i] = std::sqrt(highlight(value_towards[i], towards[i]) * highlight(value_away[i], away[i]));
    other[i] = highlight(across[i], {0, p[i], z_of(p[i])});
  }
  const float a = half_width(p, in_plane), b = half_width(p, other);
  return a > 0 && b > 0 ? std::clamp(a / b, 0.05f, 3.0f) : 1.0f;
}

/// Random distributions under random directions, eight at a time: what integrals by the model get wrong.
class Validation {
 public:
  Validation(const BoundPatterns& patterns, std::size_t pattern, const LobeModel& model)
      : patterns_(patterns), pattern_(pattern), model_(model), in_use_(widths_in_use(model)) {}
  /// Root mean square, relative.
  float error() {
    double sum = 0;
    for (int block = 0; block < kBlocks; ++block) sum += block_error(block);
    return static_cast<float>(std::sqrt(sum / (kBlocks * kLanes)));
  }

 private:
  static constexpr int kBlocks = 8, kStrata = 40;
  struct Case {
    Pair pair;
    float xx, xy, yy;
  };
  Case random_case(int index) const;
  std::vector<Vec3> normals_of(const Case& c, int index) const;
  double block_error(int block);
  static float random(int index, int number) {
    return unit_float(hash64(static_cast<std::uint64_t>(index), static_cast<std::uint64_t>(number)));
  }
  void call(const std::array<Case, kLanes>& cases, const Vec3Lanes& normals, ColourLanes& out) const;

  const BoundPatterns& patterns_;
  std::size_t pattern_;
  const LobeModel& model_;
  WidthsInUse in_use_;
};

Validation::Case Validation::random_case(int index) const {
  // A light up to 70 degrees from the normal, and a viewer up to 25 degrees from its mirror direction.
  const float theta = std::acos(1 - random(index, 0) * (1 - std::cos(70 * kPi / 180)));
  const Vec3 light{std::sin(theta), 0, std::cos(theta)};
  const float radius = std::tan(25 * kPi / 180) * std::sqrt(random(index, 1)), angle = 2 * kPi * random(index, 2);
  const Frame mirror = make_frame({-light.x, 0, light.z}, {0, 1, 0});
  Vec3 viewer = normalized(mirror.z + mirror.x * (radius * std::cos(angle)) + mirror.y * (radius * std::sin(angle)));
  viewer.z = std::max(viewer.z, 0.1f);
  // Any azimuth: what depends on it is anisotropic, and found out.
  const float azimuth = 2 * kPi * random(index, 6), cosine = std::cos(azimuth), sine = std::sin(azimuth);
  const auto turned = [&](Vec3 v) { return Vec3{cosine * v.x - sine * v.y, sine * v.x + cosine * v.y, v.z}; };
  // Standard deviations of .02 to .3, one up to three times the other.
  const float s1 = 0.02f * std::pow(15.0f, random(index, 3)), s2 = s1 / (1 + 2 * random(index, 4));
  const float turn = kPi * random(index, 5), c = std::cos(turn), s = std::sin(turn);
  return {{turned(light), turned(normalized(viewer))},
          s1 * s1 * c * c + s2 * s2 * s * s,
          (s1 * s1 - s2 * s2) * c * s,
          s1 * s1 * s * s + s2 * s2 * c * c};
}

std::vector<Vec3> Validation::normals_of(const Case& c, int index) const {
  const float l11 = std::sqrt(c.xx), l21 = c.xy / l11, l22 = std::sqrt(std::max(0.0f, c.yy - l21 * l21));
  std::vector<Vec3> normals;
  for (int j = 0; j < kStrata; ++j)
    for (int i = 0; i < kStrata; ++i) {
      const int number = 7 + 2 * (j * kStrata + i);
      const float u = (static_cast<float>(i) + random(index, number)) / kStrata;
      const float v = (static_cast<float>(j) + random(index, number + 1)) / kStrata;
      const float radius = std::sqrt(-2 * std::log(1 - std::min(u, 0.9999f)));
      const float a = radius * std::cos(2 * kPi * v), b = radius * std::sin(2 * kPi * v);
      Vec2 xy{l11 * a, l21 * a + l22 * b};
      if (const float r = length(xy); r > 0.95f) xy = xy * (0.95f / r);
      normals.push_back({xy.x, xy.y, std::sqrt(1 - dot(xy, xy))});
    }
  return normals;
}

/// The reflectance of each case at its own normal.
void Validation::call(const std::array<Case, kLanes>& cases, const Vec3Lanes& normals, ColourLanes& out) const {
  for (std::size_t i = 0; i < kLanes; ++i) {
    const Vec3 normal{normals.x.v[i], normals.y.v[i], normals.z.v[i]};
    const Rgb value = evaluate(patterns_, pattern_, cases[i].pair, {&normal, 1})[0];
    out[0].v[i] = value.r, out[1].v[i] = value.g, out[2].v[i] = value.b;
  }
}

double Validation::block_error(int block) {
  std::array<Case, kLanes> cases;
  Vec3Lanes light, viewer;
  NormalLanes normals{0.0f, 0.0f, 0.0f, 0.0f, 0.0f};
  std::array<Rgb, kLanes> truth{};
  for (std::size_t i = 0; i < kLanes; ++i) {
    const int index = block * static_cast<int>(kLanes) + static_cast<int>(i);
    const Case& c = cases[i] = random_case(index);
    light.x.v[i] = c.pair.to_light.x, light.y.v[i] = c.pair.to_light.y, light.z.v[i] = c.pair.to_light.z;
    viewer.x.v[i] = c.pair.to_viewer.x, viewer.y.v[i] = c.pair.to_viewer.y, viewer.z.v[i] = c.pair.to_viewer.z;
    normals.xx.v[i] = c.xx, normals.xy.v[i] = c.xy, normals.yy.v[i] = c.yy;
    for (const Rgb& value : evaluate(patterns_, pattern_, c.pair, normals_of(c, index)))
      truth[i] += value * (1.0f / (kStrata * kStrata));
  }
  const HalfVectorLanes half = half_vector(light, viewer);
  const LobeLanes lobes = lobes_at(model_, in_use_, half.theta_degrees);
  LobeSums sums;
  add_distribution(in_use_, lobes, half, normals, 1.0f, sums);
  const LobeValue whole = integral(in_use_, lobes, sums);
  const Vec3Lanes mean{0.0f, 0.0f, 1.0f}, brightest = brightest_normal(half, sums);
  const LobeValue at_mean = at_normal(in_use_, lobes, half, mean);
  ColourLanes there, at_centre;
  call(cases, brightest, there), call(cases, mean, at_centre);
  const ColourLanes a = calibrated(whole, at_normal(in_use_, lobes, half, brightest), there);
  const ColourLanes b = corrected(whole, at_mean, at_centre, 1.0f);
  const lanes::Float part = calibrated_part(sums, whole, at_mean);

  double sum = 0;
  for (std::size_t i = 0; i < kLanes; ++i) {
    double difference = 0, scale = 0;
    const float t[3] = {truth[i].r, truth[i].g, truth[i].b};
    for (int c = 0; c < 3; ++c) {
      const double estimate = b[c].v[i] + part.v[i] * (a[c].v[i] - b[c].v[i]);
      difference += (estimate - t[c]) * (estimate - t[c]);
      scale += t[c] * t[c];
    }
    sum += std::min(1.0, difference / std::max(scale, 1e-12));
  }
  return sum;
}

}  // namespace

LobeModel fit_lobes(const BoundPatterns& patterns, std::size_t pattern) {
  LobeModel model;
  const std::vector<float> p = offsets();
  std::vector<Vec3> normals;
  for (float q : p) normals.push_back({0, q, z_of(q)});
  for (int a = 0; a < LobeModel::kAngles; ++a) {
    const Pair pair = pair_at(LobeModel::kAngleStep * static_cast<float>(a));
    const auto values = evaluate(patterns, pattern, pair, normals);
    fit_angle(p, values, pair.to_light.z, model.angles[a]);
    model.angles[a].stretch = stretch_of(patterns, pattern, pair, p, values, model.angles[a]);
  }
  model.error = Validation(patterns, pattern, model).error();
  return model;
}

}  // namespace redmap
