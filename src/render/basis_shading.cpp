#include "render/basis_shading.h"

#include <algorithm>

#include "shader/shading_frames.h"

namespace redmap {

namespace {

/// Basis reflectances that any hit has a part of.
std::vector<std::size_t> present_in(std::span<const LaneVector<float>> weights) {
  std::vector<std::size_t> present;
  for (std::size_t b = 0; b < weights.size(); ++b)
    if (std::any_of(weights[b].begin(), weights[b].end(), [](float w) { return w > 0; })) present.push_back(b);
  return present;
}

/// Weights of the hits: sums over their distributions.
std::vector<LaneVector<float>> sums_by_hit(const NormalMixtures& mixtures) {
  const std::size_t hits = mixtures.hits();
  std::vector<LaneVector<float>> sums(mixtures.weights.size(), LaneVector<float>(padded(hits), 0.0f));
  for (std::size_t b = 0; b < sums.size(); ++b)
    for (std::size_t i = 0; i < hits; ++i)
      for (std::uint32_t k = mixtures.first[i]; k < mixtures.first[i + 1]; ++k) sums[b][i] += mixtures.weights[b][k];
  return sums;
}

/// Whether any light arrives at each hit.
std::vector<std::uint8_t> lit_hits(const ShadingBatch::Light& light) {
  std::vector<std::uint8_t> lit(light.irradiance.size());
  for (std::size_t i = 0; i < lit.size(); ++i)
    lit[i] = light.irradiance[0][i] > 0 || light.irradiance[1][i] > 0 || light.irradiance[2][i] > 0;
  return lit;
}

void gather(const Planes<3>& from, std::span<const std::uint32_t> indices, Planes<3>& to) {
  for (int c = 0; c < 3; ++c)
    for (std::size_t i = 0; i < indices.size(); ++i) to[c][i] = from[c][indices[i]];
}

void multiply(const LaneVector<float>& weights, Planes<3>& values) {
  for (int c = 0; c < 3; ++c)
    for (std::size_t i = 0; i < values.stride(); ++i) values[c][i] *= weights[i];
}

/// The distributions of the hits `indices`, where there is one each, with the weights of one basis reflectance.
NormalMixtures select(const NormalMixtures& mixtures, std::size_t basis, std::span<const std::uint32_t> indices) {
  const auto pick = [&](const LaneVector<float>& from, LaneVector<float>& to) {
    for (std::size_t i = 0; i < indices.size(); ++i) to[i] = from[indices[i]];
  };
  NormalMixtures some = NormalMixtures::one_each(indices.size(), {LaneVector<float>(padded(indices.size()), 0.0f)});
  pick(mixtures.weights[basis], some.weights[0]);
  pick(mixtures.xx, some.xx), pick(mixtures.xy, some.xy), pick(mixtures.yy, some.yy);
  if (!mixtures.turns.empty())
    for (std::uint32_t i : indices) some.turns.push_back(mixtures.turns[i]);
  return some;
}

}  // namespace

BasisShading::BasisShading(const Shader& shader, const ReductionMap& map)
    : patterns_(bind_in_frames(shader, basis_points(map), basis_frames(map))),
      transmittance_(map.basis.size()),
      emission_(map.basis.size()) {
  Planes<3> values;
  const auto keep = [&](std::vector<Rgb>& kept) {
    for (std::size_t b = 0; b < kept.size(); ++b) kept[b] = values.rgb(b);
  };
  if (shader.info().transmits) patterns_->transmittance(values), keep(transmittance_);
  if (shader.info().emits) patterns_->emission(values), keep(emission_);
  for (std::size_t b = 0; b < map.basis.size(); ++b) {
    const LobeModel model = b < map.lobes.size() ? map.lobes[b] : LobeModel{};
    const bool trusted = model.error <= kTrustedError;
    lobes_.push_back({model, widths_in_use(model), narrowest_highlight(model), trusted});
  }
}

void BasisShading::add_constants(std::span<const LaneVector<float>> weights, ShadedBatch& out) const {
  const auto add = [&](const Rgb& value, const LaneVector<float>& weight, Planes<3>& sum) {
    const float channel[3] = {value.r, value.g, value.b};
    for (int c = 0; c < 3; ++c)
      if (channel[c] != 0)
        for (std::size_t i = 0; i < sum.stride(); ++i) sum[c][i] += weight[i] * channel[c];
  };
  for (std::size_t b = 0; b < weights.size(); ++b) {
    add(emission_[b], weights[b], out.radiance);
    add(transmittance_[b], weights[b], out.transmittance);
  }
}

void BasisShading::shade(const ShadingBatch& batch, std::span<const Frame> frames,
                         std::span<const LaneVector<float>> weights, ShadedBatch& out, RenderCounts& counts) const {
  out.radiance = Planes<3>(batch.size());
  out.transmittance = Planes<3>(batch.size());
  const std::vector<std::size_t> present = present_in(weights);
  Planes<3> radiance;
  for (std::size_t light = 0; light < batch.lights.size(); ++light) {
    const DirectionPairs pairs = pairs_in_frames(batch, light, frames);
    for (std::size_t b : present) {
      patterns_->radiance_one(b, pairs, radiance);
      add_lit(weights[b].data(), radiance, batch.lights[light].irradiance, out.radiance);
    }
  }
  counts.shader_calls += present.size() * batch.size() * batch.lights.size();
  add_constants(weights, out);
}

void BasisShading::shade_around(const ShadingBatch& batch, const NormalMixtures& mixtures, ShadedBatch& out,
                                RenderCounts& counts) const {
  out.radiance = Planes<3>(batch.size());
  out.transmittance = Planes<3>(batch.size());
  const std::vector<std::size_t> present = present_in(mixtures.weights);
  Planes<3> radiance;
  for (std::size_t light = 0; light < batch.lights.size(); ++light) {
    const DirectionPairs pairs = pairs_in_frames(batch, light, batch.frames);
    const std::vector<std::uint8_t> lit = lit_hits(batch.lights[light]);
    for (std::size_t b : present) {
      patterns_->radiance_one(b, pairs, radiance);
      multiply(mixtures.weights[b], radiance);
      spread_radiance(b, pairs, mixtures, lit, radiance, out.decisions, counts);
      add_lit(nullptr, radiance, batch.lights[light].irradiance, out.radiance);
    }
  }
  counts.shader_calls += present.size() * batch.size() * batch.lights.size();
  add_constants(mixtures.weights, out);
}

void BasisShading::spread_radiance(std::size_t basis, const DirectionPairs& pairs, const NormalMixtures& mixtures,
                                   std::span<const std::uint8_t> lit, Planes<3>& radiance,
                                   std::span<Decision> decisions, RenderCounts& counts) const {
  const float narrowest = lobes_[basis].narrowest * lobes_[basis].narrowest;
  const float begin = kSpreadBegin * kSpreadBegin * narrowest, end = kSpreadEnd * kSpreadEnd * narrowest;
  // A grain has to be drawn wherever it is.
  const bool turns = !mixtures.turns.empty() && !lobes_[basis].trusted;
  std::vector<std::uint32_t> hits;
  for (std::uint32_t i = 0; i < pairs.size(); ++i)
    if (lit[i] && mixtures.weights[basis][i] > 0 && (turns || mixtures.xx[i] + mixtures.yy[i] > begin))
      hits.push_back(i);
  if (hits.empty()) return;

  const NormalMixtures some = select(mixtures, basis, hits);
  DirectionPairs some_pairs;
  some_pairs.resize(hits.size());
  Planes<3> at_mean(hits.size()), integrated(hits.size());
  gather(pairs.to_light, hits, some_pairs.to_light), gather(pairs.to_viewer, hits, some_pairs.to_viewer);
  gather(radiance, hits, at_mean);
  std::vector<Decision> some_decisions(hits.size(), Decision::kMeanNormal);
  integrate_basis(basis, some_pairs, some, 0, {}, &at_mean, integrated, some_decisions, counts);
  for (std::size_t i = 0; i < hits.size(); ++i) {
    decisions[hits[i]] = std::max(decisions[hits[i]], some_decisions[i]);
    const float part = turns ? 1.0f : std::min(1.0f, (some.xx[i] + some.yy[i] - begin) / (end - begin));
    radiance.set(hits[i], at_mean.get(i) * (1 - part) + integrated.get(i) * part);
  }
}

void BasisShading::integrate(const ShadingBatch& batch, const NormalMixtures& mixtures, ShadedBatch& out,
                             RenderCounts& counts) const {
  out.radiance = Planes<3>(batch.size());
  out.transmittance = Planes<3>(batch.size());
  const std::vector<LaneVector<float>> weights = sums_by_hit(mixtures);
  const std::vector<std::size_t> present = present_in(weights);
  Planes<3> radiance;
  for (std::size_t light = 0; light < batch.lights.size(); ++light) {
    const DirectionPairs pairs = pairs_in_frames(batch, light, batch.frames);
    const std::vector<std::uint8_t> lit = lit_hits(batch.lights[light]);
    for (std::size_t b : present) {
      radiance = Planes<3>(batch.size());
      integrate_basis(b, pairs, mixtures, b, lit, nullptr, radiance, out.decisions, counts);
      add_lit(nullptr, radiance, batch.lights[light].irradiance, out.radiance);
    }
  }
  add_constants(weights, out);
}

Rgb BasisShading::transmittance(const FilteredTexel& texel) const {
  Rgb sum;
  for (std::size_t b = 0; b < transmittance_.size(); ++b) sum += transmittance_[b] * texel.channel[b];
  return sum;
}

}  // namespace redmap
