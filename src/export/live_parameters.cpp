#include "export/live_parameters.h"

#include <algorithm>
#include <cmath>

#include "analysis/sampling.h"
#include "base/random.h"
#include "shader/shading_frames.h"
#include "user_shader/user_shader.h"

namespace redmap {

namespace {

constexpr std::uint32_t kPlaces = 1024;
/// Places count where the map itself is right: not on borders, whose texels are averages. The rest is what bytes and
/// the bake's tolerance leave.
constexpr float kRightWithin = 0.05f, kStillRightWithin = 0.1f;
/// Of the places, that many may be wrong with another value: they hold a part that is on no basis place.
constexpr double kWrongPart = 0.005;
/// How far a shading normal may turn: less than the narrowest highlight.
constexpr float kTurned = 1e-4f;
/// Ranges that span more than this are walked by factors.
constexpr float kWide = 100, kFactor = 1.5f, kRangePart = 0.25f;

/// Places of the surface and what the map says is there.
struct Probe {
  SurfacePoints points;
  std::vector<float> weights;  ///< k a place
};

Probe make_probe(const ReductionMap& map, const Surface& surface) {
  const Extent extent = map.weights.extent(0);
  const std::size_t texels = static_cast<std::size_t>(extent.width) * static_cast<std::size_t>(extent.height);
  std::vector<std::uint8_t> wanted(texels, 0);
  Random random(1);
  for (std::uint32_t i = 0; i < kPlaces; ++i) wanted[random.below(static_cast<std::uint32_t>(texels))] = 1;
  TexelPoints found;
  const Vec2 middle[] = {{0.5f, 0.5f}};
  surface.rasterize(extent, {0, 0, extent.width, extent.height}, middle, wanted, found);
  Probe probe{std::move(found.points), {}};
  for (const std::uint32_t texel : found.texel)
    for (int b = 0; b < map.weights.channels(); ++b)
      probe.weights.push_back(
          map.weights.value(0, static_cast<int>(texel) % extent.width, static_cast<int>(texel) / extent.width, b));
  return probe;
}

/// A shader at the places of a probe: how wrong the mixture of the basis is there, in units of the shader's own RMS,
/// and its shading normals.
struct Answer {
  std::vector<float> errors;
  Planes<3> normals;
  bool has_normals = false;
};

Answer ask(const ReductionMap& map, const Probe& probe, const Shader& shader) {
  const std::unique_ptr<BoundPatterns> there = shader.bind(probe.points);
  const std::unique_ptr<BoundPatterns> basis = bind_in_frames(shader, basis_points(map), basis_frames(map));
  const ReflectanceSampler sampler(shader.info());
  SampledReflectances seen, parts;
  sampler.sample(*there, seen), sampler.sample(*basis, parts);
  RowScaling scaling;
  scaling.add(seen);
  const std::vector<float> scales = scaling.scales();
  Answer answer{std::vector<float>(seen.places), {}, false};
  for (std::size_t i = 0; i < seen.places; ++i) {
    double sum = 0;
    for (int r = 0; r < seen.rows; ++r) {
      float mixed = 0;
      for (std::size_t b = 0; b < parts.places; ++b) mixed += probe.weights[i * parts.places + b] * parts.row(r)[b];
      const double difference = static_cast<double>(scales[r] * (seen.row(r)[i] - mixed));
      sum += difference * difference;
    }
    answer.errors[i] = static_cast<float>(std::sqrt(sum / seen.rows));
  }
  answer.has_normals = there->shading_normals(answer.normals);
  return answer;
}

/// Another value a component, to both sides where the range allows it.
std::vector<std::vector<float>> other_values(const ParameterInfo& info, const std::vector<float>& value) {
  const bool by_factors = info.minimum > 0 && info.maximum / info.minimum > kWide;
  std::vector<std::vector<float>> others;
  for (const float side : {-1.0f, 1.0f}) {
    std::vector<float> other = value;
    for (float& component : other) {
      component = by_factors ? component * std::pow(kFactor, side)
                             : component + side * std::max(kRangePart * (info.maximum - info.minimum),
                                                           info.type == "int" ? 1.0f : 0.0f);
      if (info.type == "int") component = std::round(component);
      component = std::clamp(component, info.minimum, info.maximum);
    }
    if (other != value) others.push_back(std::move(other));
  }
  return others;
}

std::shared_ptr<const Shader> with_value(const Shader& shader, std::size_t parameter, const std::vector<float>& value) {
  const ShaderInfo& info = shader.info();
  ParameterOverrides values;
  for (std::size_t i = 0; i < info.parameters.size(); ++i)
    values[info.parameters[i].name] = i == parameter ? value : shader.parameters()[i];
  if (info.file.empty()) return make_library_shader(info.name, values);
  return make_user_shader(info.file, info.name, {values, {}, ""});
}

bool still_holds(const Answer& baked, const Answer& changed) {
  std::size_t right = 0, wrong = 0;
  for (std::size_t i = 0; i < baked.errors.size(); ++i) {
    if (baked.errors[i] > kRightWithin) continue;
    ++right;
    bool holds = changed.errors[i] <= kStillRightWithin;
    if (baked.has_normals) holds &= dot(baked.normals.get(i), changed.normals.get(i)) > 1 - kTurned;
    if (!holds) ++wrong;
  }
  return right > 0 && static_cast<double>(wrong) <= kWrongPart * static_cast<double>(right);
}

}  // namespace

std::vector<bool> live_parameters(const ReductionMap& map, const Surface& surface, const Shader& shader) {
  const std::vector<ParameterInfo>& parameters = shader.info().parameters;
  std::vector<bool> live(parameters.size(), false);
  if (map.hides_frames || parameters.empty()) return live;
  const Probe probe = make_probe(map, surface);
  if (probe.points.size() == 0) return live;
  const Answer baked = ask(map, probe, shader);
  for (std::size_t i = 0; i < parameters.size(); ++i)
    live[i] = std::ranges::all_of(other_values(parameters[i], shader.parameters()[i]), [&](const auto& value) {
      return still_holds(baked, ask(map, probe, *with_value(shader, i, value)));
    });
  return live;
}

}  // namespace redmap
