#include "verify/stages.h"

#include "analysis/hidden_frames.h"
#include "verify/weight_probe.h"
#include "verify/weighted_shading.h"

namespace redmap {

namespace {

std::vector<float> row_scales(const Shader& shader, const SurfacePoints& places) {
  const ReflectanceSampler sampler(shader.info());
  SampledReflectances sampled;
  sampler.sample(*shader.bind(places), sampled);
  RowScaling scaling;
  scaling.add(sampled);
  return scaling.scales();
}

/// Weights in the dark: nothing but what the probes shine with.
PixelCase in_the_dark(const PixelCase& pixel) {
  PixelCase dark = pixel;
  dark.light.intensity = {}, dark.light.shadows = false;
  return dark;
}

void append(Rgb value, std::vector<float>& weights) { weights.insert(weights.end(), {value.r, value.g, value.b}); }

}  // namespace

/// Three of the weights, as the frame looks them up and as they stand in the texels.
struct StageMeter::Probe {
  std::unique_ptr<ObjectShading> looked_up, texels;
};

StageMeter::StageMeter(const Object& object, std::shared_ptr<const ReductionMap> map, const SurfacePoints& places)
    : map_(std::move(map)), own_(object.shader), shader_(own_), basis_(std::make_shared<BasisShading>(*own_, *map_)) {
  if (map_->hides_frames)
    shader_ = std::make_shared<RevealedShader>(*own_, HiddenFrames{!map_->normals.empty(), !map_->tangents.empty()});
  fitted_ = make_weighted_shading(shader_, basis_, projected_weights(*own_, *map_, row_scales(*shader_, places)));
  texels_ = make_weighted_shading(shader_, basis_, texel_weights(map_));
  for (std::size_t first = 0; first < map_->basis.size(); first += kProbedWeights) {
    const std::shared_ptr<const Shader> probe = make_weight_probe(static_cast<int>(first));
    probes_.push_back(
        {make_map_shading(probe, map_, object.surface),
         make_weighted_shading(probe, std::make_shared<BasisShading>(*probe, *map_), texel_weights(map_))});
  }
}

StageMeter::~StageMeter() = default;

std::vector<float> StageMeter::looked_up(const PixelRenderer& renderer, const PixelCase& pixel, Quality quality) const {
  const PixelCase dark = in_the_dark(pixel);
  std::vector<float> weights;
  for (const Probe& probe : probes_) append(renderer.frame(dark, probe.looked_up, quality, false).value, weights);
  weights.resize(map_->basis.size());
  return weights;
}

std::vector<float> StageMeter::under_pixel(const PixelRenderer& renderer, const PixelCase& pixel, int spp,
                                           std::uint64_t seed) const {
  const PixelCase dark = in_the_dark(pixel);
  std::vector<float> weights;
  for (const Probe& probe : probes_) append(renderer.supersample(dark, probe.texels, spp, seed).value, weights);
  weights.resize(map_->basis.size());
  return weights;
}

StageErrors StageMeter::measure(const PixelRenderer& renderer, const PixelCase& pixel, Quality quality, Rgb frame,
                                Rgb truth, int spp, std::uint64_t seed) const {
  const auto shaded_with = [&](std::vector<float> weights) {
    const auto shading = make_weighted_shading(shader_, basis_, constant_weights(std::move(weights)));
    return renderer.supersample(pixel, shading, spp, seed).value;
  };
  const Rgb fitted = renderer.supersample(pixel, fitted_, spp, seed).value;
  const Rgb texels = renderer.supersample(pixel, texels_, spp, seed).value;
  const Rgb averaged = shaded_with(under_pixel(renderer, pixel, spp, seed));
  const Rgb filtered = shaded_with(looked_up(renderer, pixel, quality));
  // That weights and directions vary together is lost where they are averaged apart: it belongs to the normals.
  return {fitted - truth, texels - fitted, filtered - averaged, (frame - filtered) + (averaged - texels)};
}

}  // namespace redmap
